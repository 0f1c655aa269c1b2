#include <algorithm>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/protocols/lms200/responses.hpp"
#include "server/protocols/lms200/status_block.hpp"
#include "tests/unit/server/emulator/devices/lms_host.hpp"

namespace seeker::emulator {
namespace {

namespace lms = lms200;
namespace code = lms200::response_code;
using lms200::SetMode;

constexpr std::uint8_t kGood = lms200::StatusByte::kGood;

const SetMode kRequestMode{lms200::operating_mode::kRequest, {}};
const SetMode kContinuousMode{lms200::operating_mode::kContinuous, {}};
const SetMode kFast{0x40, {}};

void use_38400(LmsHost& host) {
  ASSERT_EQ(host.ask(kFast), (Bytes{code::kMode, 0, kGood}));
  host.baud = 38400;
}

TEST(LmsDevice, AGoodTelegramIsAcknowledgedAndThenAnswered) {
  LmsHost host;
  host.command(kRequestMode);
  host.run(0.05);
  EXPECT_EQ(host.all, (Bytes{0x06, 0x02, 0x80, 0x03, 0x00, 0xA0, 0x00, 0x10, 0x16, 0x0A}));
}

TEST(LmsDevice, ADamagedTelegramIsAnsweredByOneNak) {
  LmsHost host;
  Bytes telegram = encode_telegram(lms::Sender::kHost, Bytes{0x20, 0x25});
  telegram.back() = static_cast<std::uint8_t>(telegram.back() ^ 1U);
  host.send(telegram);
  host.run(0.5);
  EXPECT_EQ(host.all, Bytes{0x15});
  EXPECT_EQ(host.ask(kRequestMode), (Bytes{code::kMode, 0, kGood}));
}

TEST(LmsDevice, ATelegramThatWasCutDoesNotSpoilTheNextOne) {
  LmsHost host;
  host.send(Bytes{0x02, 0x00, 0x20, 0x03, 0x77});
  host.run(0.2);
  EXPECT_EQ(host.ask(kRequestMode), (Bytes{code::kMode, 0, kGood}));
  EXPECT_EQ(host.naks, 1);
}

TEST(LmsDevice, TheReplyToAChangeOfRateComesAtTheOldRate) {
  LmsHost host;
  use_38400(host);
  EXPECT_EQ(host.ask(lms::RequestType{})->front(), code::kType);
  EXPECT_EQ(host.device.baud(), 38400U);
}

TEST(LmsDevice, TheRateChangesWhenTheReplyHasLeft) {
  LmsHost host;
  host.command(kFast);
  EXPECT_EQ(host.device.baud(), 9600U);
  host.run(0.0102);
  EXPECT_EQ(host.device.baud(), 9600U);
  host.run(0.001);
  EXPECT_EQ(host.device.baud(), 38400U);
}

TEST(LmsDevice, AtAnotherRateNothingIsUnderstood) {
  LmsHost host;
  host.baud = 38400;
  EXPECT_FALSE(host.ask(kRequestMode));
}

TEST(LmsDevice, InstallationModeNeedsThePassword) {
  LmsHost host;
  SetMode wrong = lms::enter_installation();
  wrong.parameters.back() = 'X';
  EXPECT_EQ(host.ask(wrong), (Bytes{code::kMode, 1, kGood}));
  EXPECT_EQ(host.ask(SetMode{0, {}}), (Bytes{code::kMode, 1, kGood}));
  EXPECT_EQ(host.ask(lms::enter_installation()), (Bytes{code::kMode, 0, kGood}));
}

TEST(LmsDevice, ConfigurationIsWrittenInInstallationModeOnly) {
  LmsHost host;
  const lms::SetConfig change{{0, 0, 70, 0, 0, 5, 0}};
  EXPECT_EQ(host.ask(change), (Bytes{code::kNotAccepted, kGood}));
  ASSERT_TRUE(host.ask(lms::enter_installation()));
  const auto reply = host.ask(change);
  ASSERT_TRUE(reply);
  EXPECT_TRUE(lms::decode_config_written(*reply)->accepted);
  EXPECT_EQ(host.device.flash().measuring_mode, 5);
  EXPECT_EQ(host.device.flash().unit, 0);
}

TEST(LmsDevice, AnImpossibleUnitIsRefusedAndChangesNothing) {
  LmsHost host;
  ASSERT_TRUE(host.ask(lms::enter_installation()));
  const auto reply = host.ask(lms::SetConfig{{0, 0, 70, 0, 0, 0, 7}});
  ASSERT_TRUE(reply);
  EXPECT_FALSE(lms::decode_config_written(*reply)->accepted);
  EXPECT_EQ(host.device.flash().unit, 1);
}

TEST(LmsDevice, WhatItDoesNotKnowIsNotAccepted) {
  LmsHost host;
  for (const Bytes& payload : {Bytes{0x66}, Bytes{0x3B, 1}, Bytes{0x30, 9}, Bytes{0x10, 0}}) {
    host.send(encode_telegram(lms::Sender::kHost, payload));
    host.run(0.1);
    EXPECT_EQ(host.telegram(), (Bytes{code::kNotAccepted, kGood}));
  }
}

TEST(LmsDevice, VariantsItHasNotAreRefusedWithTheOneItHas) {
  LmsHost host;
  const auto reply = lms::decode_variant(*host.ask(lms::SetVariant{{180, 25}}));
  EXPECT_FALSE(reply->accepted);
  EXPECT_EQ(reply->variant, (lms::Variant{180, 100}));
  EXPECT_EQ(*host.ask(lms::SetVariant{{180, 50}}), (Bytes{code::kVariant, 1, 180, 0, 50, 0, kGood}));
}

TEST(LmsDevice, TheStatusBlockSaysWhatWasSet) {
  LmsHost host;
  use_38400(host);
  ASSERT_TRUE(host.ask(lms::SetVariant{{100, 25}}));
  const auto payload = host.ask(lms::RequestStatus{});
  ASSERT_TRUE(payload);
  EXPECT_EQ(payload->size(), 152U);
  const auto status = lms::decode_status_block(*payload);
  EXPECT_EQ(status->variant, (lms::Variant{100, 25}));
  EXPECT_EQ(status->unit, 1);
  EXPECT_EQ(status->operating_mode, 0x25);
  EXPECT_EQ(status->baud_word, 0x8019);
  EXPECT_FALSE(status->defective);
}

TEST(LmsDevice, OneScanIsSentOnRequest) {
  LmsHost host;
  host.command(lms::RequestValues{});
  const auto scan = host.scan();
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->words.size(), 181U);
  EXPECT_EQ(scan->words[0], 1000);
  EXPECT_EQ(scan->words[1], 1002);  // every other of the half degrees
  EXPECT_EQ(scan->words[180], 1360);
  EXPECT_FALSE(host.scan());
}

TEST(LmsDevice, QuarterDegreesLieBetweenHalfDegrees) {
  LmsHost host;
  ASSERT_TRUE(host.ask(lms::SetVariant{{100, 25}}));
  host.command(lms::RequestValues{});
  const auto scan = host.scan();
  ASSERT_TRUE(scan);
  ASSERT_EQ(scan->words.size(), 401U);
  EXPECT_EQ(scan->words[0], 1080);  // 40 degrees from the rightmost beam of 180
  EXPECT_NEAR(scan->words[1], 1080.5, 0.6);
  EXPECT_EQ(scan->words[2], 1081);
  EXPECT_EQ(scan->words[400], 1280);
}

TEST(LmsDevice, At38400BaudScansOfHalfADegreeComeEightScansApart) {
  LmsHost host;
  use_38400(host);
  ASSERT_TRUE(host.ask(lms::SetVariant{{180, 50}}));
  ASSERT_TRUE(host.ask(kContinuousMode));
  host.run(0.5);
  const std::size_t before = host.all.size();
  host.run(16.0);
  EXPECT_NEAR(static_cast<double>(host.all.size() - before) / 732.0, 16.0 * 75.0 / 16.0, 1.0);
  ASSERT_TRUE(host.scan());
}

TEST(LmsDevice, ASubRangeHasItsOwnResponseAndComesMoreOften) {
  LmsHost host;
  use_38400(host);
  ASSERT_TRUE(host.ask(lms::SetVariant{{180, 50}}));
  EXPECT_EQ(host.ask(lms::continuous_sub_range({0, 5})), (Bytes{code::kMode, 1, kGood}));
  EXPECT_EQ(host.ask(lms::continuous_sub_range({300, 362})), (Bytes{code::kMode, 1, kGood}));
  ASSERT_EQ(host.ask(lms::continuous_sub_range({91, 100})), (Bytes{code::kMode, 0, kGood}));
  const auto scan = host.scan();
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->sub_range, (lms::SubRange{91, 100}));
  ASSERT_EQ(scan->words.size(), 10U);
  EXPECT_EQ(scan->words[0], 1090);
  const std::size_t before = host.all.size();
  host.run(1.0);
  EXPECT_NEAR(static_cast<double>(host.all.size() - before) / 34.0, 37.5, 1.5);
}

TEST(LmsDevice, RequestModeEndsTheOutput) {
  LmsHost host;
  ASSERT_TRUE(host.ask(kContinuousMode));
  ASSERT_TRUE(host.scan());
  host.command(kRequestMode);
  host.run(1.5);
  const std::size_t after = host.all.size();
  host.run(5.0);
  EXPECT_EQ(host.all.size(), after);
}

TEST(LmsDevice, IndicesFollowTheValuesWhereTheyAreWanted) {
  LmsDeviceParams params = millimetre_device();
  params.flash.availability = lms::ConfigBlock::kRealTimeIndex;
  params.sends_telegram_index = true;
  LmsHost host(params);
  host.command(lms::RequestValues{});
  const auto first = host.scan();
  host.command(lms::RequestValues{});
  const auto second = host.scan();
  ASSERT_TRUE(first && second);
  EXPECT_TRUE(first->real_time_index);
  EXPECT_NE(first->real_time_index, second->real_time_index);
  EXPECT_EQ(*second->telegram_index, *first->telegram_index + 1);
}

TEST(LmsDevice, AResetIsAnsweredAndEndsWithThePowerOnTelegramAt9600Baud) {
  LmsHost host;
  use_38400(host);
  ASSERT_TRUE(host.ask(lms::SetVariant{{180, 50}}));
  EXPECT_EQ(host.ask(lms::Reset{}), (Bytes{code::kReset, kGood}));
  host.baud = 9600;
  host.command(kRequestMode);  // it does not listen while it starts
  host.run(3.0);
  const auto power_on = host.telegram();
  ASSERT_TRUE(power_on);
  EXPECT_EQ(power_on->front(), code::kPowerOn);
  EXPECT_EQ(*lms::decode_text(*power_on), "LMS200;30106;V02.30");
  EXPECT_FALSE(host.telegram());
  EXPECT_EQ(lms::decode_status_block(*host.ask(lms::RequestStatus{}))->variant, (lms::Variant{180, 100}));
}

TEST(LmsDevice, OnlyTheFlashOutlivesAPowerCycle) {
  LmsHost host;
  ASSERT_TRUE(host.ask(lms::enter_installation()));
  ASSERT_TRUE(host.ask(lms::SetConfig{{0, 0, 70, 0, 0, 5, 0}}));
  use_38400(host);
  ASSERT_TRUE(host.ask(kContinuousMode));
  ASSERT_TRUE(host.scan());
  host.device.power_cycle(host.now);
  EXPECT_EQ(host.device.baud(), 9600U);
  host.run(0.3);  // what was on the line
  while (host.telegram()) {
  }
  host.baud = 9600;
  const std::size_t before = host.all.size();
  host.run(1.6);
  EXPECT_EQ(host.all.size(), before);
  host.run(3.0);
  EXPECT_EQ(host.telegram()->front(), code::kPowerOn);
  EXPECT_FALSE(host.scan());
  EXPECT_EQ(host.device.flash().measuring_mode, 5);
}

TEST(LmsDevice, PollutionAndErrorsAreInStatusBytesStatusBlockAndList) {
  LmsHost host;
  host.device.set_faults({true, true, 0.0});
  const auto errors = host.ask(lms::RequestErrors{});
  ASSERT_TRUE(errors);
  EXPECT_EQ(errors->back(), 0x94);
  EXPECT_EQ(lms::decode_errors(*errors)->size(), 2U);
  const auto status = lms::decode_status_block(*host.ask(lms::RequestStatus{}));
  EXPECT_TRUE(status->defective);
  EXPECT_LT(status->pollution[0], status->pollution_calibration[0]);
  host.device.set_faults({});
  EXPECT_EQ(host.ask(lms::RequestErrors{}), (Bytes{code::kErrors, kGood}));
}

TEST(LmsDevice, WrongChecksumsComeAsOftenAsWanted) {
  LmsHost host;
  host.device.set_faults({false, false, 0.25});
  int answered = 0;
  for (int i = 0; i < 400; ++i) {
    host.command(lms::RequestType{});
    host.run(0.06);
    answered += host.telegram() ? 1 : 0;
  }
  EXPECT_NEAR(answered, 300, 40);
}

TEST(LmsDevice, AFloodOfCommandsIsNotStored) {
  LmsHost host;
  const Bytes command = encode_telegram(lms::Sender::kHost, Bytes{0x31});
  Bytes flood;
  for (int i = 0; i < 10000; ++i) {
    flood.insert(flood.end(), command.begin(), command.end());
  }
  host.device.receive(flood, host.now);
  host.run(30.0);
  EXPECT_LT(host.all.size(), 33U * 160U);
  EXPECT_TRUE(host.ask(kRequestMode));
}

RC_GTEST_PROP(LmsDevice, AnyBytesAreEnduredAndTheNextCommandIsAnswered, ()) {
  LmsHost host;
  for (int i = *rc::gen::inRange(0, 20); i > 0; --i) {
    const Bytes bytes = *rc::gen::arbitrary<Bytes>();
    if (*rc::gen::arbitrary<bool>() && !bytes.empty()) {
      host.send(encode_telegram(lms::Sender::kHost, bytes));
    } else {
      host.send(bytes);
    }
    host.run(0.01 * *rc::gen::inRange(0, 30));
  }
  host.baud = host.device.baud();
  host.run(0.2);
  host.command(lms::RequestType{});
  host.run(3.0);
  std::optional<Bytes> answer;
  while (auto payload = host.telegram()) {
    answer = payload->front() == code::kType ? payload : answer;
  }
  // A reset among the bytes ends with the power-on telegram instead.
  RC_ASSERT(answer.has_value() || std::find(host.all.begin(), host.all.end(), code::kReset) != host.all.end());
}

TEST(LmsDevice, RangesBeyondTheModesLimitAreCodes) {
  LmsDeviceParams params = millimetre_device();
  LmsDevice device(params, [](RobotTime now) {
    LaserScan scan = numbered_scan(now);
    scan.ranges_m[0] = kNoReturn;
    scan.ranges_m[2] = 8.5F;
    return scan;
  });
  device.receive(encode_telegram(lms::Sender::kHost, Bytes{0x30, 1}), RobotTime());
  for (double t_s = 0.0; t_s < 0.2; t_s += 0.001) {
    device.pass(robot_time_s(t_s));
  }
  lms::TelegramReader reader(lms::Sender::kDevice);
  reader.feed(device.take_output());
  ASSERT_TRUE(reader.next());
  const auto scan = lms::decode_scan(reader.next()->payload, false);
  EXPECT_EQ(scan->words[0], 8183);
  EXPECT_EQ(scan->words[1], 8183);
  EXPECT_EQ(scan->words[2], 1004);
}

}  // namespace
}  // namespace seeker::emulator
