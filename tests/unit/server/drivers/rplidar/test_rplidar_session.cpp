// The handshake step by step, with a device that the test plays.
#include "server/drivers/rplidar/rplidar_session.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/protocols/rplidar/descriptor.hpp"

namespace seeker::drivers {
namespace {

using rplidar::Command;
using std::chrono::milliseconds;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Bytes = std::vector<std::uint8_t>;

const rplidar::DeviceInfo kA1{0x18, {1, 20}, 5, {}};
const rplidar::DeviceInfo kA2{0x28, {1, 29}, 6, {}};

/// A session at a line of which the test is the other end.
class Desk {
 public:
  explicit Desk(const RplidarParams& params = {}) : session(params) {
    session.open(now);
    opening = session.take_actions();
  }

  /// Bytes that the session has written since the last call.
  Bytes written() {
    Bytes all;
    for (const LineAction& action : session.take_actions()) {
      if (const auto* write = std::get_if<WriteBytes>(&action)) {
        all.insert(all.end(), write->bytes.begin(), write->bytes.end());
      }
    }
    return all;
  }
  /// Lets time pass up to the session's next timer and returns what it writes then.
  Bytes next_timer() {
    now = session.wake();
    session.pass(now);
    return written();
  }
  Bytes receive(const Bytes& bytes) {
    now += milliseconds(1);
    session.receive(bytes, now);
    return written();
  }
  /// Answers twice, as every question is asked twice, and returns what is asked next.
  Bytes answer(const Bytes& bytes) {
    const Bytes repeated = receive(bytes);
    EXPECT_FALSE(repeated.empty());
    return receive(bytes);
  }

  RobotTime now = robot_time_s(5.0);
  RplidarSession session;
  std::vector<LineAction> opening;
};

Bytes request(Command command) { return rplidar::encode(rplidar::Request{command, {}}); }

TEST(RplidarSession, OpensWithTheRateTheRotorAndStop) {
  Desk desk;
  ASSERT_EQ(desk.opening.size(), 3U);
  EXPECT_EQ(std::get<SetBaud>(desk.opening[0]).baud, 115'200U);
  EXPECT_FALSE(std::get<SetDtr>(desk.opening[1]).on) << "cleared: the rotor turns";
  EXPECT_EQ(std::get<WriteBytes>(desk.opening[2]).bytes, request(Command::kStop));
  EXPECT_EQ(desk.session.state().error().code, Errc::kNotReady);
  EXPECT_EQ(desk.session.wake(), desk.now + milliseconds(100));
}

TEST(RplidarSession, StartsAnA1InCapsules) {
  Desk desk;
  EXPECT_EQ(desk.next_timer(), request(Command::kGetInfo));
  EXPECT_EQ(desk.answer(rplidar::encode(kA1)), request(Command::kGetHealth));
  EXPECT_EQ(desk.answer(rplidar::encode(rplidar::Health{})), request(Command::kGetSampleRate));
  EXPECT_EQ(desk.answer(rplidar::encode(rplidar::SampleRate{500, 250})), rplidar::encode(rplidar::express_scan(0)));
  EXPECT_FALSE(desk.session.state()) << "no turn yet";
}

TEST(RplidarSession, StartsAnA2WithItsMotorAndItsTypicalMode) {
  using rplidar::ConfAnswer;
  using rplidar::ConfType;
  Desk desk;
  desk.next_timer();
  desk.answer(rplidar::encode(kA2));
  desk.answer(rplidar::encode(rplidar::Health{}));
  EXPECT_EQ(desk.answer(rplidar::encode(rplidar::SampleRate{500, 250})),
            rplidar::encode(rplidar::get_acc_board_flag()));
  EXPECT_EQ(desk.answer(rplidar::encode(rplidar::AccBoard{true})),
            rplidar::encode(rplidar::get_conf(ConfType::kTypicalMode)));
  EXPECT_EQ(desk.answer(rplidar::encode(ConfAnswer{ConfType::kTypicalMode, {1, 0}})),
            rplidar::encode(rplidar::get_conf(ConfType::kAnswerType, 1)));
  EXPECT_EQ(desk.answer(rplidar::encode(ConfAnswer{ConfType::kAnswerType, {0x82}})),
            rplidar::encode(rplidar::get_conf(ConfType::kSamplePeriod, 1)));
  Bytes expected = rplidar::encode(rplidar::set_motor_pwm(660));
  const Bytes scan = rplidar::encode(rplidar::express_scan(1));
  expected.insert(expected.end(), scan.begin(), scan.end());
  EXPECT_EQ(desk.answer(rplidar::encode(ConfAnswer{ConfType::kSamplePeriod, {0x00, 0xFA, 0, 0}})), expected);
}

TEST(RplidarSession, AModeThatSendsOtherwiseIsLeftForTheOneThatAllHave) {
  using rplidar::ConfAnswer;
  using rplidar::ConfType;
  RplidarParams params;
  params.motor = RplidarMotor::kDtr;
  Desk desk(params);
  desk.next_timer();
  desk.answer(rplidar::encode(kA2));
  desk.answer(rplidar::encode(rplidar::Health{}));
  desk.answer(rplidar::encode(rplidar::SampleRate{500, 250}));
  desk.answer(rplidar::encode(ConfAnswer{ConfType::kTypicalMode, {2, 0}}));
  EXPECT_EQ(desk.answer(rplidar::encode(ConfAnswer{ConfType::kAnswerType, {0x84}})),
            rplidar::encode(rplidar::express_scan(0)));
}

TEST(RplidarSession, ADamagedAnswerIsAskedForUntilTwoAgree) {
  Desk desk;
  desk.next_timer();
  rplidar::DeviceInfo damaged = kA1;
  damaged.model ^= 0x30;
  EXPECT_EQ(desk.receive(rplidar::encode(damaged)), request(Command::kGetInfo));
  EXPECT_EQ(desk.receive(rplidar::encode(kA1)), request(Command::kGetInfo));
  EXPECT_EQ(desk.receive(rplidar::encode(kA1)), request(Command::kGetHealth));
}

TEST(RplidarSession, HalfAnAnswerDoesNotSwallowTheNextOne) {
  Desk desk;
  desk.next_timer();
  Bytes half = rplidar::encode(kA1);
  half.resize(15);
  EXPECT_THAT(desk.receive(half), IsEmpty());
  EXPECT_EQ(desk.next_timer(), request(Command::kGetInfo));
  EXPECT_EQ(desk.answer(rplidar::encode(kA1)), request(Command::kGetHealth));
}

TEST(RplidarSession, RepetitionsOfAnAnswerAreNotTakenForTheNextOne) {
  Desk desk;
  desk.next_timer();
  Bytes many;
  for (int k = 0; k < 6; ++k) {
    const Bytes info = rplidar::encode(kA1);
    many.insert(many.end(), info.begin(), info.end());
  }
  Bytes expected = request(Command::kGetInfo);
  const Bytes health = request(Command::kGetHealth);
  expected.insert(expected.end(), health.begin(), health.end());
  EXPECT_EQ(desk.receive(many), expected);
  EXPECT_THAT(desk.receive(rplidar::encode(kA1)), IsEmpty());
}

TEST(RplidarSession, TriesTheOtherRateAndThenSaysWhatToCheck) {
  Desk desk;
  desk.next_timer();
  EXPECT_EQ(desk.next_timer(), request(Command::kGetInfo));
  EXPECT_EQ(desk.next_timer(), request(Command::kGetInfo));
  desk.now = desk.session.wake();
  desk.session.pass(desk.now);
  const std::vector<LineAction> actions = desk.session.take_actions();
  ASSERT_EQ(actions.size(), 2U);
  EXPECT_EQ(std::get<SetBaud>(actions[0]).baud, 256'000U);
  for (int k = 0; k < 4; ++k) {
    EXPECT_FALSE(desk.session.wants_reopen());
    desk.next_timer();
  }
  EXPECT_TRUE(desk.session.wants_reopen());
  EXPECT_EQ(desk.session.state().error().code, Errc::kLinkLost);
  EXPECT_THAT(desk.session.state().error().message, HasSubstr("power"));
  desk.session.open(desk.now);
  EXPECT_FALSE(desk.session.wants_reopen());
}

TEST(RplidarSession, ProtectionStopIsResetTwiceAndThenReported) {
  Desk desk;
  const Bytes stopped = rplidar::encode(rplidar::Health{rplidar::HealthStatus::kProtectionStop, 0x8002});
  for (int resets = 0; resets < 2; ++resets) {
    desk.next_timer();
    desk.answer(rplidar::encode(kA1));
    EXPECT_EQ(desk.answer(stopped), request(Command::kReset));
    EXPECT_EQ(desk.session.wake(), desk.now + std::chrono::seconds(2));
    EXPECT_THAT(desk.receive({'R', 'P', ' ', 'L', 'I', 'D', 'A', 'R'}), IsEmpty());
  }
  desk.next_timer();
  desk.answer(rplidar::encode(kA1));
  EXPECT_THAT(desk.answer(stopped), IsEmpty());
  EXPECT_TRUE(desk.session.wants_reopen());
  EXPECT_EQ(desk.session.state().error().code, Errc::kInternal);
  EXPECT_THAT(desk.session.state().error().message, HasSubstr("0x8002"));
}

TEST(RplidarSession, AWarningIsToldWhileItGoesOn) {
  Desk desk;
  desk.next_timer();
  desk.answer(rplidar::encode(kA1));
  EXPECT_FALSE(desk.session.warning());
  EXPECT_EQ(desk.answer(rplidar::encode(rplidar::Health{rplidar::HealthStatus::kWarning, 0x0101})),
            request(Command::kGetSampleRate));
  ASSERT_TRUE(desk.session.warning());
  EXPECT_THAT(desk.session.warning()->message, HasSubstr("0x0101"));
}

TEST(RplidarSession, FallsBackToSingleSamplesWhereCapsulesAreNotKnown) {
  Desk desk;
  desk.next_timer();
  desk.answer(rplidar::encode(kA1));
  desk.answer(rplidar::encode(rplidar::Health{}));
  desk.answer(rplidar::encode(rplidar::SampleRate{500, 250}));
  EXPECT_EQ(desk.next_timer(), rplidar::encode(rplidar::express_scan(0)));
  desk.next_timer();
  EXPECT_EQ(desk.next_timer(), request(Command::kScan));
}

TEST(RplidarSession, ADeviceThatCannotSayHowFastItMeasuresIsTakenForOneOfTheFirst) {
  Desk desk;
  desk.next_timer();
  desk.answer(rplidar::encode(kA1));
  EXPECT_EQ(desk.answer(rplidar::encode(rplidar::Health{})), request(Command::kGetSampleRate));
  Bytes sent = desk.next_timer();
  for (int again = 0; again < 5 && sent == request(Command::kGetSampleRate); ++again) {
    sent = desk.next_timer();
  }
  EXPECT_EQ(sent, rplidar::encode(rplidar::express_scan(0)));
  EXPECT_EQ(desk.session.state().error().code, Errc::kNotReady);
}

TEST(RplidarSession, ARotorThatDoesNotTurnIsReportedInTheEnd) {
  RplidarParams params;
  params.restarts = 1;
  Desk desk(params);
  for (int start = 0; start < 2; ++start) {
    desk.next_timer();
    desk.answer(rplidar::encode(kA1));
    desk.answer(rplidar::encode(rplidar::Health{}));
    desk.answer(rplidar::encode(rplidar::SampleRate{500, 250}));
    const auto announced =
        rplidar::encode(rplidar::Descriptor{rplidar::kCapsuleBytes, true, rplidar::AnswerType::kExpressScan});
    desk.receive({announced.begin(), announced.end()});
    EXPECT_THAT(desk.session.state().error().message, HasSubstr("rotor"));
    EXPECT_EQ(desk.session.wake(), desk.now + std::chrono::seconds(5));
    desk.next_timer();
  }
  EXPECT_TRUE(desk.session.wants_reopen());
  EXPECT_THAT(desk.session.state().error().message, HasSubstr("rotor runs freely"));
}

TEST(RplidarSession, SaysFarewellByStoppingScanAndMotor) {
  Desk desk;
  desk.session.close(desk.now);
  const std::vector<LineAction> actions = desk.session.take_actions();
  ASSERT_EQ(actions.size(), 2U);
  EXPECT_EQ(std::get<WriteBytes>(actions[0]).bytes, request(Command::kStop));
  EXPECT_TRUE(std::get<SetDtr>(actions[1]).on);
  EXPECT_EQ(desk.session.state().error().code, Errc::kNotReady);
  EXPECT_EQ(desk.session.wake(), RobotTime::max());
}

TEST(RplidarParams, ImpossibleSettingsAreRefusedByName) {
  EXPECT_TRUE(validate(RplidarParams{}));
  const auto refused = [](const auto& spoil) {
    RplidarParams params;
    spoil(params);
    const Status status = validate(params);
    return status ? std::string() : status.error().message;
  };
  EXPECT_THAT(refused([](RplidarParams& p) { p.bauds.clear(); }), HasSubstr("bauds"));
  EXPECT_THAT(refused([](RplidarParams& p) { p.motor_pwm = 1024; }), HasSubstr("motor_pwm"));
  EXPECT_THAT(refused([](RplidarParams& p) { p.range_min_m = 20.0; }), HasSubstr("range_min_m"));
  EXPECT_THAT(refused([](RplidarParams& p) { p.angle_step_rad = 1e-6; }), HasSubstr("angle_step_rad"));
  EXPECT_THAT(refused([](RplidarParams& p) { p.least_revolution_share = 0.0; }), HasSubstr("least_revolution_share"));
  EXPECT_THAT(refused([](RplidarParams& p) { p.tries = 0; }), HasSubstr("tries"));
  EXPECT_THAT(refused([](RplidarParams& p) { p.scan_timeout = {}; }), HasSubstr("time-outs"));
}

}  // namespace
}  // namespace seeker::drivers
