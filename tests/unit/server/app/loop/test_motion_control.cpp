// What reaches the base: only what the supervisor allows, and only while somebody wants motion on purpose.

#include <gtest/gtest.h>

#include "server/app/loop/motion_control.hpp"
#include "tests/unit/server/app/loop/fake_robot.hpp"

namespace seeker::app {
namespace {

using std::chrono::milliseconds;

class MotionControlTest : public ::testing::Test {
 protected:
  MotionControlTest() {
    diagnostics.components().add("base", "driver", "fake", {});
    diagnostics.components().activate_all();
  }
  static Devices devices_of(const MotionControlTest& test) {
    Devices devices;
    devices.type = "fake";
    devices.clock = test.clock;
    devices.base = test.base;
    return devices;
  }

  std::shared_ptr<testing::HandClock> clock = std::make_shared<testing::HandClock>();
  std::shared_ptr<testing::FakeBase> base = std::make_shared<testing::FakeBase>();
  UpdateHub hub;
  LoopHooks hooks;
  Diagnostics diagnostics{clock, hub, hooks};
  WorldLink world{clock, "fake", milliseconds(100), std::chrono::seconds(10), diagnostics};
  Sensing sensing{LoopParams{}, devices_of(*this), world, diagnostics};
  Neighbours neighbours{FleetMotionParams{}};
  Localiser localiser{LoopParams{}, nav::OccupancyParams{}, std::make_unique<testing::FakeEstimator>(), diagnostics};
  SituationSource situation{world, sensing, localiser, neighbours, false};
  MotionControl motion{SafetyParams{}, base, sensing, situation, world, diagnostics};
};

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
