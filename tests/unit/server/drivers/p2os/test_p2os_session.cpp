#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "server/protocols/p2os/gyro_packet.hpp"
#include "tests/support/matchers.hpp"
#include "tests/unit/server/drivers/p2os/talk.hpp"

namespace seeker::drivers {
namespace {

using p2os::CommandId;
using seeker::testing::Pose2Near;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(P2osSession, VelocitiesAreSentWhenTheyChangeAndAgainWhileTheBaseMoves) {
  Talk talk;
  talk.connect();
  talk.session.set_velocity({0.25, deg_to_rad(10.0)}, talk.now);
  EXPECT_THAT(talk.heard(), ElementsAre(command(CommandId::kVel, 250), command(CommandId::kRotVel, 10)));
  talk.session.set_velocity({0.25, deg_to_rad(-10.0)}, talk.now);
  EXPECT_THAT(talk.heard(), ElementsAre(command(CommandId::kRotVel, -10)));
  talk.inform();
  talk.inform();
  EXPECT_THAT(talk.heard(), IsEmpty());
  talk.inform();
  EXPECT_THAT(talk.heard(), ElementsAre(command(CommandId::kVel, 250), command(CommandId::kRotVel, -10)));
}

TEST(P2osSession, AnUnchangedVelocityIsNotSentAtEachCall) {
  Talk talk;
  talk.connect();
  talk.session.set_velocity({0.25, 0.0}, talk.now);
  talk.heard();
  talk.session.set_velocity({0.25, 0.0}, talk.now + kMs(50));
  EXPECT_THAT(talk.heard(), IsEmpty());
}

TEST(P2osSession, AStopIsRepeatedUntilTheWheelsStand) {
  Talk talk;
  talk.connect();
  talk.session.set_velocity({0.25, 0.0}, talk.now);
  talk.sip.left_velocity = talk.sip.right_velocity = 250;
  talk.inform();
  talk.session.set_velocity({}, talk.now);
  talk.heard();
  talk.inform();
  talk.inform();
  talk.inform();
  EXPECT_THAT(talk.heard(), ElementsAre(command(CommandId::kVel, 0), command(CommandId::kRotVel, 0)));
  talk.sip.left_velocity = talk.sip.right_velocity = 0;
  talk.say(p2os::write_sip(talk.sip));
  for (int k = 0; k < 6; ++k) {
    talk.inform();
  }
  EXPECT_THAT(talk.heard(), IsEmpty());
}

TEST(P2osSession, ASmallVelocityIsNotLostInRounding) {
  EXPECT_EQ(to_vel({0.0002, deg_to_rad(0.2)}), (WireVelocity{1, 1}));
  EXPECT_EQ(to_vel({-0.0002, deg_to_rad(-0.2)}), (WireVelocity{-1, -1}));
  EXPECT_EQ(to_vel({1e-9, -1e-9}), (WireVelocity{0, 0}));
  EXPECT_EQ(to_vel({0.2506, deg_to_rad(10.4)}), (WireVelocity{251, 10}));
  const auto& model = *p2os::find_pioneer_model("p3dx-sh");
  EXPECT_EQ(to_vel2({0.002, 0.0}, model).first, p2os::vel2_argument({1, 1}));
  EXPECT_EQ(to_vel2({0.1, 0.0}, model).first, p2os::vel2_argument({5, 5}));
  // 0.1 m/s of the wheels against each other turn by 0.1 * 5.6 rad/s, counter-clockwise with the right one forwards.
  EXPECT_EQ(to_vel2({0.0, 0.56}, model).first, p2os::vel2_argument({-5, 5}));
}

TEST(P2osSession, TheWheelsAreCommandedWhereThatIsWanted) {
  P2osParams params;
  params.use_vel2 = true;
  Talk talk(params);
  talk.connect();
  talk.session.set_velocity({0.1, 0.0}, talk.now);
  EXPECT_THAT(talk.heard(), ElementsAre(command(CommandId::kVel2, p2os::vel2_argument({5, 5}))));
}

TEST(P2osSession, ACommandIsClampedToTheLimits) {
  P2osParams params;
  params.v_max_m_s = 0.4;
  params.omega_max_rad_s = deg_to_rad(50.0);
  Talk talk(params);
  talk.connect();
  talk.session.set_velocity({3.0, -9.0}, talk.now);
  EXPECT_THAT(talk.heard(), ElementsAre(command(CommandId::kVel, 400), command(CommandId::kRotVel, -50)));
}

TEST(P2osSession, WithoutANewerVelocityTheBaseIsStopped) {
  Talk talk;
  talk.connect();
  talk.session.set_velocity({0.25, 0.0}, talk.now);
  for (int k = 0; k < 4; ++k) {
    talk.inform();
  }
  EXPECT_THAT(talk.heard(), ::testing::Not(Contains(command(CommandId::kStop))));
  talk.inform();
  EXPECT_THAT(talk.heard(),
              ElementsAre(command(CommandId::kStop), command(CommandId::kVel, 0), command(CommandId::kRotVel, 0)));
  talk.inform();
  EXPECT_THAT(talk.heard(), IsEmpty());
}

TEST(P2osSession, PulsesComeFromTheLoopAndNotFromATimer) {
  Talk talk;
  talk.connect();
  for (int k = 0; k < 30; ++k) {
    talk.inform();
  }
  EXPECT_THAT(talk.heard(), IsEmpty());
  for (int k = 0; k < 20; ++k) {
    talk.session.loop_alive(talk.now);
    talk.inform();
  }
  const auto pulses = talk.heard();
  EXPECT_EQ(pulses.size(), 5U);
  EXPECT_THAT(pulses, ::testing::Each(command(CommandId::kPulse)));
}

TEST(P2osSession, ABumperHaltsTheBaseInTheCallThatBringsTheNews) {
  Talk talk;
  talk.connect();
  talk.session.set_velocity({0.25, 0.1}, talk.now);
  talk.pass(kMs(100));
  talk.heard();
  talk.sip.stall_right_front = 0x04;
  talk.say(p2os::write_sip(talk.sip));
  EXPECT_THAT(talk.heard(), ElementsAre(command(CommandId::kVel, 0), command(CommandId::kRotVel, 0)));
  EXPECT_TRUE(talk.session.take_odometry()->bumped);
  EXPECT_THAT(talk.session.base_fault()->message, HasSubstr("bumper in front"));
}

TEST(P2osSession, WhileABumperIsPressedTheBaseMovesOnlyAwayFromIt) {
  Talk talk;
  talk.connect();
  talk.sip.stall_right_front = 0x80;
  talk.inform();
  talk.heard();
  talk.session.set_velocity({0.25, 0.0}, talk.now);
  EXPECT_THAT(talk.heard(), IsEmpty());
  talk.session.set_velocity({-0.1, 0.0}, talk.now);
  EXPECT_THAT(talk.heard(), ElementsAre(command(CommandId::kVel, -100)));
  talk.sip.stall_right_front = 0;
  talk.sip.stall_left_rear = 0x02;
  talk.inform();
  EXPECT_THAT(talk.heard(), ElementsAre(command(CommandId::kVel, 0), command(CommandId::kRotVel, 0)));
  talk.session.set_velocity({-0.1, 0.0}, talk.now);
  EXPECT_THAT(talk.heard(), IsEmpty());
  talk.session.set_velocity({0.1, 0.0}, talk.now);
  EXPECT_THAT(talk.heard(), ElementsAre(command(CommandId::kVel, 100)));
  EXPECT_THAT(talk.session.base_fault()->message, HasSubstr("rear"));
}

TEST(P2osSession, BumpersThatAreNotUsedStopNothing) {
  P2osParams params;
  params.use_bumpers = false;
  Talk talk(params);
  talk.connect();
  talk.sip.stall_right_front = 0x80;
  talk.inform();
  talk.session.set_velocity({0.25, 0.0}, talk.now);
  EXPECT_THAT(talk.heard(), ElementsAre(command(CommandId::kVel, 250)));
  EXPECT_FALSE(talk.session.base_fault());
}

TEST(P2osSession, AReleasedBumperAllowsAllMotionAgain) {
  Talk talk;
  talk.connect();
  talk.sip.stall_right_front = 0x80;
  talk.inform();
  talk.sip.stall_right_front = 0;
  talk.inform();
  talk.heard();
  EXPECT_FALSE(talk.session.base_fault());
  talk.session.set_velocity({0.25, 0.0}, talk.now);
  EXPECT_THAT(talk.heard(), ElementsAre(command(CommandId::kVel, 250)));
}

TEST(P2osSession, AStalledWheelHaltsTheBaseAndRefusesTheWayItWasGoing) {
  Talk talk;
  talk.connect();
  talk.session.set_velocity({0.25, 0.0}, talk.now);
  talk.heard();
  talk.sip.stall_left_rear = p2os::kWheelStalled;
  talk.inform();
  EXPECT_THAT(talk.heard(), ElementsAre(command(CommandId::kVel, 0), command(CommandId::kRotVel, 0)));
  EXPECT_TRUE(talk.session.take_odometry()->stalled);
  talk.session.set_velocity({0.25, 0.0}, talk.now);
  EXPECT_THAT(talk.heard(), IsEmpty());
  talk.session.set_velocity({-0.25, 0.0}, talk.now);
  EXPECT_THAT(talk.heard(), ElementsAre(command(CommandId::kVel, -250)));
  EXPECT_THAT(talk.session.base_fault()->message, HasSubstr("blocked"));
}

TEST(P2osSession, TheEmergencyStopRefusesAllMotionAndSaysSo) {
  for (const std::uint16_t bit : {p2os::flag::kEStop, p2os::flag::kEStall, p2os::flag::kChargerPower}) {
    Talk talk;
    talk.connect();
    talk.session.set_velocity({0.25, 0.0}, talk.now);
    talk.heard();
    talk.sip.flags = bit;
    talk.inform();
    EXPECT_THAT(talk.heard(), ElementsAre(command(CommandId::kVel, 0), command(CommandId::kRotVel, 0)));
    talk.session.set_velocity({-0.25, 0.3}, talk.now);
    EXPECT_THAT(talk.heard(), IsEmpty());
    ASSERT_TRUE(talk.session.base_fault());
    EXPECT_EQ(talk.session.base_fault()->code, Errc::kNotReady);
  }
}

TEST(P2osSession, AChargeStateKeepsTheBaseAtItsCharger) {
  Talk talk;
  talk.connect();
  talk.sip.ports = 0;
  talk.sip.analog = talk.sip.digital_in = talk.sip.digital_out = 0;
  talk.sip.battery_x10 = 131;
  talk.sip.charge_state = static_cast<std::uint8_t>(p2os::ChargeState::kUnknown);
  talk.inform();
  EXPECT_FALSE(talk.session.base_fault());
  EXPECT_DOUBLE_EQ(talk.session.take_odometry()->battery_v.value(), 13.1);
  talk.sip.charge_state = static_cast<std::uint8_t>(p2os::ChargeState::kFloat);
  talk.inform();
  EXPECT_THAT(talk.session.base_fault()->message, HasSubstr("charger"));
}

TEST(P2osSession, MotorsAreCommandedUntilTheBaseShowsThem) {
  Talk talk;
  talk.connect();
  talk.session.set_motors(true, talk.now);
  EXPECT_THAT(talk.heard(), ElementsAre(command(CommandId::kEnable, 1)));
  for (int k = 0; k < 5; ++k) {
    talk.inform();
  }
  EXPECT_THAT(talk.heard(), ElementsAre(command(CommandId::kEnable, 1)));
  talk.sip.flags = p2os::flag::kMotorsOn;
  for (int k = 0; k < 9; ++k) {
    talk.inform();
  }
  EXPECT_THAT(talk.heard(), IsEmpty());
  EXPECT_TRUE(talk.session.take_odometry()->motors_enabled);
  EXPECT_FALSE(talk.session.base_fault());
}

TEST(P2osSession, TheBaseIsStoppedBeforeItsMotorsAreSwitchedOff) {
  Talk talk;
  talk.connect();
  talk.session.set_motors(true, talk.now);
  talk.session.set_velocity({0.3, 0.2}, talk.now);
  talk.heard();
  talk.session.set_motors(false, talk.now);
  EXPECT_THAT(talk.heard(), ElementsAre(command(CommandId::kStop), command(CommandId::kVel, 0),
                                        command(CommandId::kRotVel, 0), command(CommandId::kEnable, 0)));
}

TEST(P2osSession, MotorsThatAreSwitchedOffAtTheBaseStayOffAndAreReported) {
  Talk talk;
  talk.connect();
  talk.session.set_motors(true, talk.now);
  talk.sip.flags = p2os::flag::kMotorsOn;
  talk.inform();
  talk.heard();
  talk.sip.flags = 0;
  for (int k = 0; k < 9; ++k) {
    talk.inform();
  }
  EXPECT_THAT(talk.heard(), IsEmpty());
  EXPECT_THAT(talk.session.base_fault()->message, HasSubstr("switched off at the base"));
}

TEST(P2osSession, SilenceOfHalfASecondIsALostLink) {
  Talk talk;
  talk.connect();
  talk.pass(kMs(499));
  EXPECT_TRUE(talk.session.state());
  talk.pass(kMs(1));
  EXPECT_EQ(talk.session.state().error().code, Errc::kLinkLost);
  EXPECT_TRUE(talk.session.wants_reopen());
  EXPECT_THAT(talk.heard(), Contains(command(CommandId::kStop)));
}

TEST(P2osSession, ThePoseGoesOnOverConnections) {
  Talk talk;
  talk.connect();
  talk.sip.x = 100;
  talk.inform();
  EXPECT_THAT(talk.session.take_odometry()->odom_T_base, Pose2Near(Pose2{0.1, 0.0, 0.0}, 1e-9, 1e-9));
  talk.pass(std::chrono::seconds(1));
  talk.session.open(talk.now);
  talk.sip = {};
  talk.sip.y = 5000;
  talk.sip.theta = 1024;  // a right angle
  talk.connect();
  talk.inform();
  EXPECT_THAT(talk.session.take_odometry()->odom_T_base, Pose2Near(Pose2{0.1, 0.0, 0.0}, 1e-9, 1e-9));
  // Along the y axis of the counters is forwards now.
  talk.sip.y = 5050;
  talk.inform();
  EXPECT_THAT(talk.session.take_odometry()->odom_T_base, Pose2Near(Pose2{0.15, 0.0, 0.0}, 1e-9, 1e-9));
}

TEST(P2osSession, NothingMovesWhenAConnectionComesAbout) {
  Talk talk;
  talk.session.set_velocity({0.3, 0.0}, talk.now);
  talk.connect();
  talk.pass(kMs(300));
  for (const auto& heard : talk.heard()) {
    EXPECT_EQ(heard.integer().value_or(0), 0);
  }
}

TEST(P2osSession, TheFarewellStopsTheBaseAndClosesTheConnection) {
  Talk talk;
  talk.connect();
  talk.session.close(talk.now);
  EXPECT_THAT(talk.heard(),
              ElementsAre(command(CommandId::kStop), command(CommandId::kVel, 0), command(CommandId::kEnable, 0),
                          command(CommandId::kSonar, 0), command(CommandId::kClose, 1)));
  EXPECT_EQ(talk.session.state().error().code, Errc::kNotReady);
  EXPECT_FALSE(talk.session.wants_reopen());
  EXPECT_EQ(talk.session.wake(), RobotTime::max());
}

TEST(P2osSession, ASampleIsStampedWhenItsPacketBeganOnASerialLine) {
  Talk talk;
  talk.connect();
  talk.inform();
  const auto bytes = static_cast<double>(p2os::encode(p2os::write_sip(talk.sip)).size());
  EXPECT_NEAR(to_seconds(talk.now - talk.session.take_odometry()->stamp), bytes * 10.0 / 9600.0, 1e-6);
}

TEST(P2osSession, DamagedInformationIsCountedAndChangesNothing) {
  Talk talk;
  talk.connect();
  const auto before = talk.session.statistics().packets_bad;
  talk.say(p2os::PacketId::kSipMoving);
  EXPECT_EQ(talk.session.statistics().packets_bad, before + 1);
  EXPECT_FALSE(talk.session.take_odometry());
}

}  // namespace
}  // namespace seeker::drivers
