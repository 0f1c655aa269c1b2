// What reaches the base: only what the supervisor allows, and only while somebody wants motion on purpose.

#include <gtest/gtest.h>

#include "tests/unit/server/app/loop/fake_deck.hpp"

namespace seeker::app {
namespace {

class MotionControlTest : public ::testing::Test, protected testing::FakeDeck {};

TEST_F(MotionControlTest, ADisarmedRobotIsNotEvenCommandedToStand) {
  motion.act({0.3, 0.0});
  EXPECT_FALSE(base->motors);
  EXPECT_TRUE(base->commanded.empty());
}

TEST_F(MotionControlTest, AFaultThatForbidsMotionPowersTheMotorsOff) {
  motion.authority().arm();
  motion.act({0.1, 0.0});
  EXPECT_TRUE(base->motors);
  diagnostics.raise("lidar-silent", "lidar", "nothing comes", "check the cable");
  motion.act({0.1, 0.0});
  EXPECT_FALSE(base->motors);
  EXPECT_FALSE(motion.safety_reason().empty());
}

TEST_F(MotionControlTest, ARobotThatMayNotMoveAnyMoreIsCommandedToStandBeforeItsMotorsArePoweredOff) {
  motion.authority().arm();
  motion.act({0.1, 0.0});
  ASSERT_EQ(base->commanded.back(), (Twist2{0.1, 0.0}));
  EXPECT_TRUE(motion.set_estop(true));
  motion.act({0.1, 0.0});
  EXPECT_FALSE(base->motors);
  EXPECT_EQ(base->commanded.back(), Twist2{});
}

TEST_F(MotionControlTest, ABaseThatRefusesIsAFault) {
  motion.authority().arm();
  base->accepts = fail(Errc::kRefused, "not today");
  motion.act({0.1, 0.0});
  EXPECT_TRUE(diagnostics.faults().find("base-refused"));
}

TEST_F(MotionControlTest, ALatchedEmergencyStopIsToldOnceAndStaysUntilItIsReleased) {
  motion.authority().arm();
  EXPECT_TRUE(motion.set_estop(true));
  EXPECT_FALSE(motion.set_estop(true));
  motion.act({0.1, 0.0});
  EXPECT_FALSE(base->motors);
  EXPECT_TRUE(motion.set_estop(false));
  EXPECT_FALSE(motion.authority().armed()) << "somebody must move it on purpose";
}

TEST_F(MotionControlTest, ARestartedComponentLeavesTheRobotDisarmed) {
  motion.authority().arm();
  motion.restarted("lidar");
  EXPECT_FALSE(motion.authority().armed());
}

TEST_F(MotionControlTest, ABaseWhoseWheelsAreLargerThanItReckonsIsToldToDriveSlower) {
  MotionControl calibrated{params.safety, {.left_scale = 1.25, .right_scale = 1.25}, base, sensing, situation, world,
                           diagnostics};
  calibrated.authority().arm();
  calibrated.act({0.1, 0.2});
  ASSERT_FALSE(base->commanded.empty());
  EXPECT_DOUBLE_EQ(base->commanded.back().v_m_s, 0.08);
  EXPECT_DOUBLE_EQ(base->commanded.back().omega_rad_s, 0.16);
}

TEST_F(MotionControlTest, HaltStandsStillAndPowersOff) {
  motion.authority().arm();
  motion.act({0.1, 0.0});
  motion.halt();
  EXPECT_FALSE(base->motors);
  ASSERT_FALSE(base->commanded.empty());
  EXPECT_EQ(base->commanded.back(), Twist2{});
}

}  // namespace
}  // namespace seeker::app
