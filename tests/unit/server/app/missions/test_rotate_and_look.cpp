#include "server/app/missions/rotate_and_look.hpp"

#include <gtest/gtest.h>

#include "common/core/angle.hpp"

namespace seeker::app {
namespace {

/// Turns as it is told.
class Turning {
 public:
  explicit Turning(int headings) : sweep(params()) { sweep.start(pose, headings); }

  static RotateAndLookParams params() {
    RotateAndLookParams p;
    p.settle_s = 0.3;
    p.tries = 2;
    return p;
  }
  /// Until a look is wanted; false when the sweep ends, or 60 s have passed.
  bool until_look() {
    for (int k = 0; k < 600 && sweep.active(); ++k) {
      Decision decision;
      sweep.step(pose, situation, decision);
      situation.now += std::chrono::milliseconds(100);
      if (!stuck) {
        pose.theta_rad = wrap_angle(pose.theta_rad + 0.1 * decision.command.omega_rad_s);
        situation.velocity = decision.command;
      }
      left_out += static_cast<int>(decision.events.size());
      if (decision.wants_look) {
        return true;
      }
    }
    return false;
  }

  Situation situation;
  Pose2 pose{1.0, 2.0, 0.5};
  RotateAndLook sweep;
  bool stuck = false;
  int left_out = 0;
};

TEST(RotateAndLook, LooksIntoEvenlySpacedDirectionsFromTheOneItHas) {
  Turning robot(4);
  for (int k = 0; k < 4; ++k) {
    ASSERT_TRUE(robot.until_look()) << k;
    EXPECT_NEAR(wrap_angle(robot.pose.theta_rad - (0.5 + k * kPi / 2.0)), 0.0, 0.06) << k;
    EXPECT_NEAR(robot.situation.velocity.omega_rad_s, 0.0, 0.02);
    robot.sweep.looked();
  }
  EXPECT_FALSE(robot.sweep.active());
  EXPECT_EQ(robot.left_out, 0);
}

TEST(RotateAndLook, AsksOnceAndWaits) {
  Turning robot(2);
  ASSERT_TRUE(robot.until_look());
  EXPECT_FALSE(robot.until_look());
  EXPECT_EQ(robot.sweep.index(), 0);
}

TEST(RotateAndLook, ABadLookIsTriedAgainThenItsDirectionIsLeftOut) {
  Turning robot(2);
  ASSERT_TRUE(robot.until_look());
  EXPECT_FALSE(robot.sweep.failed());
  ASSERT_TRUE(robot.until_look());
  EXPECT_TRUE(robot.sweep.failed());
  EXPECT_EQ(robot.sweep.index(), 1);
}

TEST(RotateAndLook, ADirectionThatCannotBeReachedIsLeftOut) {
  Turning robot(3);
  ASSERT_TRUE(robot.until_look());
  robot.sweep.looked();
  robot.stuck = true;
  EXPECT_FALSE(robot.until_look());
  EXPECT_FALSE(robot.sweep.active());
  EXPECT_EQ(robot.left_out, 2);
}

}  // namespace
}  // namespace seeker::app
