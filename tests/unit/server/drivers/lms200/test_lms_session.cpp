// The session step by step, against bytes of the protocol's document.
#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/drivers/lms200/lms_session.hpp"
#include "server/protocols/lms200/responses.hpp"
#include "server/protocols/lms200/scan_telegram.hpp"
#include "server/protocols/lms200/status_block.hpp"

namespace seeker::drivers {
namespace {

namespace lms = lms200;
using Bytes = std::vector<std::uint8_t>;

constexpr std::uint8_t kGood = lms200::StatusByte::kGood;
const Bytes kRequestMode{0x02, 0x00, 0x02, 0x00, 0x20, 0x25, 0x35, 0x08};
const Bytes kSet38400{0x02, 0x00, 0x02, 0x00, 0x20, 0x40, 0x50, 0x08};
const Bytes kModeDone{0xA0, 0x00, 0x10};

/// A device that answers with what the test says.
class Script {
 public:
  explicit Script(const LmsParams& params = {}) : session(params) { session.open(now); }

  /// The bytes that were written since the last call.
  Bytes written() {
    Bytes bytes;
    for (const LineAction& action : session.take_actions()) {
      if (const auto* write = std::get_if<WriteBytes>(&action)) {
        bytes.insert(bytes.end(), write->bytes.begin(), write->bytes.end());
      } else if (const auto* rate = std::get_if<SetBaud>(&action)) {
        baud = rate->baud;
      }
    }
    return bytes;
  }
  void reply(const Bytes& payload) {
    Bytes bytes{lms::kAckByte};
    const Bytes telegram = encode_telegram(lms::Sender::kDevice, payload);
    bytes.insert(bytes.end(), telegram.begin(), telegram.end());
    session.receive(bytes, now);
  }
  void run(double time_s) {
    now += seconds(time_s);
    session.pass(now);
  }
  /// Lets the handshake succeed up to its output.
  void reach_output() {
    reply(kModeDone);
    reply(lms::encode_text(lms::response_code::kType, "LMS200;30106;V02.30", kGood));
    reply(encode(lms::StatusBlock(), kGood));
    reply(encode(lms::VariantReply{true, {180, 50}}, kGood));
    reply(lms::encode_config(millimetres(), kGood));
    reply(kModeDone);
    (void)written();
  }
  [[nodiscard]] static lms::ConfigBlock millimetres() {
    lms::ConfigBlock config;
    config.unit = 1;
    return config;
  }
  void send_scan(std::size_t values, std::uint8_t status = kGood) {
    lms::ScanTelegram scan;
    scan.unit = lms::Unit::kMillimetre;
    scan.words.assign(values, 1500);
    session.receive(encode_telegram(lms::Sender::kDevice, encode(scan, status)), now);
  }
  [[nodiscard]] Error error() const {
    const Status state = session.state();
    return state ? Error{} : state.error();
  }
  [[nodiscard]] bool says(const std::string& part) const { return error().message.find(part) != std::string::npos; }

  RobotTime now = robot_time_s(100.0);
  LmsSession session;
  std::uint32_t baud = 0;
};

TEST(LmsSession, TheWantedRateIsTriedFirstThenTheOthers) {
  Script script;
  EXPECT_EQ(script.written(), kRequestMode);
  EXPECT_EQ(script.baud, 38400U);
  std::vector<std::uint32_t> rates;
  for (int i = 0; i < 6; ++i) {
    script.now = script.session.wake();
    script.session.pass(script.now);
    EXPECT_EQ(script.written(), kRequestMode);
    rates.push_back(script.baud);
  }
  EXPECT_EQ(rates, (std::vector<std::uint32_t>{38400, 9600, 9600, 19200, 19200, 38400}));
  EXPECT_EQ(script.error().code, Errc::kNotReady);
}

TEST(LmsSession, TheRateIsChangedAfterTheReplyAndConfirmed) {
  Script script;
  (void)script.written();
  for (int i = 0; i < 2; ++i) {
    script.now = script.session.wake();
    script.session.pass(script.now);
  }
  (void)script.written();
  ASSERT_EQ(script.baud, 9600U);
  script.reply(kModeDone);
  EXPECT_EQ(script.written(), kSet38400);
  EXPECT_EQ(script.baud, 9600U);
  script.reply(kModeDone);
  EXPECT_TRUE(script.written().empty());
  EXPECT_EQ(script.baud, 38400U);
  script.run(0.25);
  EXPECT_EQ(script.written(), kRequestMode);
}

TEST(LmsSession, TheOrderIsTypeStatusVariantConfigurationOutput) {
  Script script;
  (void)script.written();
  script.reply(kModeDone);
  EXPECT_EQ(script.written(), (Bytes{0x02, 0x00, 0x01, 0x00, 0x3A, 0x1E, 0x12}));
  script.reply(lms::encode_text(lms::response_code::kType, "LMS200;30106;V02.30", kGood));
  EXPECT_EQ(script.written(), (Bytes{0x02, 0x00, 0x01, 0x00, 0x31, 0x15, 0x12}));
  script.reply(encode(lms::StatusBlock(), kGood));
  EXPECT_EQ(script.written(), (Bytes{0x02, 0x00, 0x05, 0x00, 0x3B, 0xB4, 0x00, 0x32, 0x00, 0x3B, 0x1F}));
  script.reply({0xBB, 0x01, 0xB4, 0x00, 0x32, 0x00, 0x10});
  EXPECT_EQ(script.written(), (Bytes{0x02, 0x00, 0x01, 0x00, 0x74, 0x50, 0x12}));
  script.reply(lms::encode_config(Script::millimetres(), kGood));
  EXPECT_EQ(script.written(), (Bytes{0x02, 0x00, 0x02, 0x00, 0x20, 0x24, 0x34, 0x08}));
  script.reply(kModeDone);
  EXPECT_TRUE(script.says("first scan"));
  script.send_scan(361);
  EXPECT_TRUE(script.session.state().has_value());
}

TEST(LmsSession, TheFlashIsWrittenInInstallationModeWithTheOtherBytesAsTheyAre) {
  LmsParams params;
  params.may_write_flash = true;
  Script script(params);
  script.reply(kModeDone);
  script.reply(lms::encode_text(lms::response_code::kType, "LMS200", kGood));
  script.reply(encode(lms::StatusBlock(), kGood));
  script.reply({0xBB, 0x01, 0xB4, 0x00, 0x32, 0x00, 0x10});
  lms::ConfigBlock config;
  config.contours[3] = 42;
  (void)script.written();
  script.reply(lms::encode_config(config, kGood));
  EXPECT_EQ(script.written(),
            (Bytes{0x02, 0x00, 0x0A, 0x00, 0x20, 0x00, 0x53, 0x49, 0x43, 0x4B, 0x5F, 0x4C, 0x4D, 0x53, 0xBE, 0xC5}));
  script.reply(kModeDone);
  config.unit = 1;
  const auto block = encode(config);
  EXPECT_EQ(script.written(),
            encode_telegram(lms::Sender::kHost, encode(lms::Command(lms::SetConfig{{block.begin(), block.end()}}))));
  script.run(14.0);
  EXPECT_TRUE(script.written().empty());  // the device takes its time
  script.reply(encode(lms::ConfigWrittenReply{true, config}, kGood));
  EXPECT_EQ(script.written(), (Bytes{0x02, 0x00, 0x02, 0x00, 0x20, 0x24, 0x34, 0x08}));
}

TEST(LmsSession, ASubRangeIsAskedForByItsFirstAndLastValue) {
  LmsParams params;
  params.sub_range = lms::SubRange{91, 271};
  Script script(params);
  script.reply(kModeDone);
  script.reply(lms::encode_text(lms::response_code::kType, "LMS200", kGood));
  script.reply(encode(lms::StatusBlock(), kGood));
  script.reply({0xBB, 0x01, 0xB4, 0x00, 0x32, 0x00, 0x10});
  (void)script.written();
  script.reply(lms::encode_config(Script::millimetres(), kGood));
  EXPECT_EQ(script.written(), encode_telegram(lms::Sender::kHost, Bytes{0x20, 0x27, 0x5B, 0x00, 0x0F, 0x01}));
}

TEST(LmsSession, ANakHasTheTelegramSentAgainAFewTimes) {
  Script script;
  script.reply(kModeDone);
  (void)script.written();
  for (int i = 0; i < 2; ++i) {
    script.session.receive(Bytes{lms::kNakByte}, script.now);
    EXPECT_TRUE(script.written().empty());
    script.run(0.1);
    EXPECT_EQ(script.written(), (Bytes{0x02, 0x00, 0x01, 0x00, 0x3A, 0x1E, 0x12}));
  }
  script.session.receive(Bytes{lms::kNakByte}, script.now);
  EXPECT_TRUE(script.session.wants_reopen());
  EXPECT_EQ(script.error().code, Errc::kRefused);
  EXPECT_TRUE(script.says("check the cable"));
}

TEST(LmsSession, WhatIsNotAcceptedAfterSomeTriesIsNamed) {
  Script script;
  script.reply(kModeDone);
  for (int i = 0; i < 3; ++i) {
    script.reply({0x92, 0x10});
    script.run(0.1);
  }
  EXPECT_TRUE(script.session.wants_reopen());
  EXPECT_TRUE(script.says("the question for its type"));
}

TEST(LmsSession, AnotherDeviceIsNotUsed) {
  Script script;
  script.reply(kModeDone);
  for (int i = 0; i < 3; ++i) {
    script.reply(lms::encode_text(lms::response_code::kType, "PLS101", kGood));
    script.run(0.1);
  }
  EXPECT_TRUE(script.says("PLS101"));
  EXPECT_TRUE(script.session.wants_reopen());
}

TEST(LmsSession, AVariantThatTheDeviceHasNotIsNamed) {
  Script script;
  script.reply(kModeDone);
  script.reply(lms::encode_text(lms::response_code::kType, "LMS200", kGood));
  script.reply(encode(lms::StatusBlock(), kGood));
  for (int i = 0; i < 3; ++i) {
    script.reply({0xBB, 0x00, 0xB4, 0x00, 0x64, 0x00, 0x10});
    script.run(0.1);
  }
  EXPECT_TRUE(script.says("180/0.5 deg"));
}

TEST(LmsSession, RepliesOfADeviceWithAFatalErrorAreNoSuccess) {
  Script script;
  for (int i = 0; i < 3; ++i) {
    script.reply({0xA0, 0x00, 0x14});
    script.run(0.1);
  }
  EXPECT_TRUE(script.session.wants_reopen());
  EXPECT_TRUE(script.says("fatal"));
}

TEST(LmsSession, ADefectiveDevicesErrorsAreListedInTheWarning) {
  Script script;
  script.reply(kModeDone);
  script.reply(lms::encode_text(lms::response_code::kType, "LMS200", kGood));
  lms::StatusBlock status;
  status.defective = true;
  (void)script.written();
  script.reply(encode(status, 0x13));
  EXPECT_EQ(script.written(), (Bytes{0x02, 0x00, 0x01, 0x00, 0x32, 0x16, 0x12}));
  script.reply({0xB2, 0x03, 0x11, 0x13});
  script.reply({0xBB, 0x01, 0xB4, 0x00, 0x32, 0x00, 0x13});
  script.reply(lms::encode_config(Script::millimetres(), 0x13));
  script.reply({0xA0, 0x00, 0x13});
  script.send_scan(361, 0x13);
  EXPECT_TRUE(script.session.take_scan());
  ASSERT_TRUE(script.session.warning());
  EXPECT_NE(script.session.warning()->message.find("type 3 number 17"), std::string::npos);
}

TEST(LmsSession, APowerOnTelegramInTheHandshakeBeginsItAgain) {
  Script script;
  script.reply(kModeDone);
  (void)script.written();
  script.reply(lms::encode_text(lms::response_code::kPowerOn, "LMS200", kGood));
  EXPECT_EQ(script.written(), kRequestMode);
}

TEST(LmsSession, APowerOnTelegramBetweenScansIsALostLink) {
  Script script;
  script.reach_output();
  script.send_scan(361);
  script.reply(lms::encode_text(lms::response_code::kPowerOn, "LMS200", kGood));
  EXPECT_EQ(script.error().code, Errc::kLinkLost);
  EXPECT_TRUE(script.session.wants_reopen());
}

TEST(LmsSession, ScansOfAnotherVariantAreCountedAndNotUsed) {
  Script script;
  script.reach_output();
  script.send_scan(181);
  EXPECT_FALSE(script.session.take_scan());
  EXPECT_EQ(script.session.statistics().packets_bad, 1U);
  script.send_scan(361);
  const auto scan = script.session.take_scan();
  ASSERT_TRUE(scan);
  EXPECT_FLOAT_EQ(scan->ranges_m[0], 1.5F);
  EXPECT_NEAR(scan->angle_min_rad, -1.5707963, 1e-6);
  EXPECT_FALSE(script.session.take_scan());
}

TEST(LmsSession, AScanThatIsNotNewerThanTheLastOneIsDropped) {
  Script script;
  script.reach_output();
  script.run(1.0);
  script.send_scan(361);
  EXPECT_TRUE(script.session.take_scan());
  script.send_scan(361);  // at the same time
  EXPECT_FALSE(script.session.take_scan());
}

TEST(LmsSession, WithoutScansForTheTimeoutTheLineIsGivenUp) {
  Script script;
  script.reach_output();
  EXPECT_EQ(script.session.wake(), script.now + seconds(2.0));
  script.run(1.99);
  EXPECT_FALSE(script.session.wants_reopen());
  script.run(0.01);
  EXPECT_TRUE(script.session.wants_reopen());
  EXPECT_EQ(script.error().code, Errc::kLinkLost);
  EXPECT_TRUE(script.says("sends nothing"));
}

TEST(LmsSession, TheRestOfATelegramThatWasCutIsNotWaitedFor) {
  Script script;
  (void)script.written();
  Bytes bytes{0x02, 0x80, 0x20, 0x03};  // of a scan from before
  const Bytes reply = encode_telegram(lms::Sender::kDevice, kModeDone);
  bytes.insert(bytes.end(), reply.begin(), reply.end());
  script.session.receive(bytes, script.now);
  EXPECT_TRUE(script.written().empty());
  script.run(0.25);
  EXPECT_FALSE(script.written().empty());
  EXPECT_TRUE(script.says("type"));
}

TEST(LmsSession, TheFarewellIsRequestModeAndTheFirstRate) {
  Script script;
  script.run(3.0);
  script.run(3.0);
  (void)script.written();
  ASSERT_EQ(script.baud, 9600U);
  script.reply(kModeDone);
  script.reply(kModeDone);
  script.run(0.25);
  script.reach_output();
  script.session.close(script.now);
  Bytes farewell = kRequestMode;
  const Bytes rate{0x02, 0x00, 0x02, 0x00, 0x20, 0x42, 0x52, 0x08};
  farewell.insert(farewell.end(), rate.begin(), rate.end());
  EXPECT_EQ(script.written(), farewell);
  EXPECT_EQ(script.baud, 9600U);
  EXPECT_EQ(script.error().code, Errc::kNotReady);
}

TEST(LmsSession, ADeviceThatWasNotFoundGetsNoFarewell) {
  Script script;
  (void)script.written();
  script.session.close(script.now);
  EXPECT_TRUE(script.written().empty());
}

RC_GTEST_PROP(LmsSession, AnyTelegramsAtAnyTimeAreEndured, ()) {
  Script script;
  for (int i = *rc::gen::inRange(0, 60); i > 0; --i) {
    Bytes payload = *rc::gen::nonEmpty(rc::gen::arbitrary<Bytes>());
    if (*rc::gen::inRange(0, 3) > 0) {
      payload.front() =
          *rc::gen::element<std::uint8_t>(0x90, 0x92, 0xA0, 0xB0, 0xB1, 0xB2, 0xB7, 0xBA, 0xBB, 0xF4, 0xF7);
    }
    if (*rc::gen::inRange(0, 4) == 0) {
      script.reach_output();
    }
    script.reply(payload);
    script.run(0.001 * *rc::gen::inRange(0, 3000));
    RC_ASSERT(script.session.wake() > script.now || script.session.wake() == RobotTime::max());
    RC_ASSERT(script.session.state().has_value() || !script.session.state().error().message.empty());
  }
}

TEST(LmsParams, DefaultsAreValidAndWhatTheDeviceHasNotIsRefused) {
  EXPECT_TRUE(validate(LmsParams()).has_value());
  const auto refused = [](auto change) {
    LmsParams params;
    change(params);
    const Status status = validate(params);
    return !status.has_value() && status.error().code == Errc::kInvalidArgument;
  };
  EXPECT_TRUE(refused([](LmsParams& p) { p.baud = 115200; }));
  EXPECT_TRUE(refused([](LmsParams& p) { p.search_bauds = {4800}; }));
  EXPECT_TRUE(refused([](LmsParams& p) { p.variant = {180, 25}; }));
  EXPECT_TRUE(refused([](LmsParams& p) { p.sub_range = lms::SubRange{0, 5}; }));
  EXPECT_TRUE(refused([](LmsParams& p) { p.sub_range = lms::SubRange{5, 4}; }));
  EXPECT_TRUE(refused([](LmsParams& p) { p.sub_range = lms::SubRange{1, 362}; }));
  EXPECT_TRUE(refused([](LmsParams& p) { p.measuring_mode = lms::MeasuringMode::kReflectivity; }));
  EXPECT_TRUE(refused([](LmsParams& p) { p.scan_timeout_s = 0.3; }));
  EXPECT_TRUE(refused([](LmsParams& p) { p.reply_timeout_s = 0.0; }));
  EXPECT_TRUE(refused([](LmsParams& p) { p.tries = 0; }));
  EXPECT_TRUE(refused([](LmsParams& p) { p.base_T_laser.x_m = std::nan(""); }));
}

}  // namespace
}  // namespace seeker::drivers
