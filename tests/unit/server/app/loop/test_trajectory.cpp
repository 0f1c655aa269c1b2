// Where the robot has been: spacing and bounded memory.

#include <gtest/gtest.h>

#include "server/app/loop/trajectory.hpp"

namespace seeker::app {
namespace {

RobotTime at(int second) { return RobotTime(std::chrono::seconds(second)); }

TEST(Trajectory, KeepsPosesThatAreTheSpacingApart) {
  Trajectory trajectory(0.1, 100);
  for (int k = 0; k < 10; ++k) {
    trajectory.add(at(k), Pose2{0.04 * k, 0.0, 0.0});
  }
  ASSERT_EQ(trajectory.stamped().size(), 4U) << "0, 0.12, 0.24 and 0.36 m";
  EXPECT_EQ(trajectory.stamped()[1].stamp, at(3));
  EXPECT_EQ(trajectory.poses().size(), 4U);
}

TEST(Trajectory, ThinsItsOlderHalfWhenItIsFull) {
  Trajectory trajectory(0.1, 10);
  for (int k = 0; k < 1000; ++k) {
    trajectory.add(at(k), Pose2{1.0 * k, 0.0, 0.0});
    ASSERT_LE(trajectory.stamped().size(), 10U);
  }
  EXPECT_EQ(trajectory.stamped().front().map_T_base.x_m, 0.0) << "where it began stays";
  EXPECT_EQ(trajectory.stamped().back().map_T_base.x_m, 999.0);
}

TEST(Trajectory, IsEmptyAfterAnotherMapWasLoaded) {
  Trajectory trajectory(0.1, 10);
  trajectory.add(at(0), {});
  trajectory.clear();
  EXPECT_TRUE(trajectory.stamped().empty());
}

}  // namespace
}  // namespace seeker::app
