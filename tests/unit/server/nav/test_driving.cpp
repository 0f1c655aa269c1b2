#include <gtest/gtest.h>

#include "server/nav/planned_driver.hpp"
#include "tests/support/matchers.hpp"
#include "tests/unit/server/nav/round_scan.hpp"

namespace seeker::nav {
namespace {

using seeker::testing::Point2Near;

/// A base that does what it is told, on free floor of 6 x 6 m about the origin.
class Drive : public ::testing::Test {
 protected:
  Drive() {
    for (int k = 0; k < 4; ++k) {
      EXPECT_TRUE(map_.integrate(round_scan(3.0F), {}));
    }
    floors_.attend(map_, pose_, now_);
  }

  [[nodiscard]] DriveInput input() { return {now_, pose_, nullptr, nullptr, floors_}; }

  DriveState tick() {
    constexpr double kTick_s = 0.1;
    floors_.attend(map_, pose_, now_);
    step_ = driver_.step(input());
    pose_ = pose_ * integrate(step_.command, kTick_s);
    now_ += seconds(kTick_s);
    return step_.state;
  }

  /// Drives to (0, 0), then over to `next_map` as soon as the robot would brake. Returns its least speed between the
  /// moment of going on and the one where it has passed.
  double least_speed_on_the_way_through(const Point2& next_map) {
    EXPECT_TRUE(driver_.start(input(), {0, 0}));
    while (tick() == DriveState::kDriving && !driver_.brakes_within(0.3, step_)) {
    }
    EXPECT_TRUE(driver_.go_on(input(), next_map));
    double least_m_s = 1.0;
    while (driver_.passes_through() && tick() == DriveState::kDriving) {
      least_m_s = std::min(least_m_s, step_.command.v_m_s);
      nearest_m_ = std::min(nearest_m_, pose_.translation().norm());
    }
    return least_m_s;
  }

  OccupancyMap map_;
  FloorSource floors_{{}, {}, 0.25, 1.0};
  PlannedDriver driver_{{}};
  Pose2 pose_{-2.0, 0.0, 0.0};
  RobotTime now_ = robot_time_s(1.0);
  DriveStep step_;
  double nearest_m_ = 1.0;  ///< to (0, 0), where it went through
};

TEST_F(Drive, LeadsThroughAGoalWithoutAStopWhereTheNextLiesAhead) {
  EXPECT_GT(least_speed_on_the_way_through({2.0, 0.1}), 0.4);
  EXPECT_LT(nearest_m_, 0.15);
  while (tick() == DriveState::kDriving) {
  }
  EXPECT_EQ(step_.state, DriveState::kArrived);
  EXPECT_THAT(pose_.translation(), Point2Near(Point2(2.0, 0.1), 0.15));
}

TEST_F(Drive, SlowsWhereThePathTurnsBackAtTheGoal) {
  EXPECT_LT(least_speed_on_the_way_through({-1.0, 1.0}), 0.25);
  EXPECT_LT(nearest_m_, 0.15);
  while (tick() == DriveState::kDriving) {
  }
  EXPECT_THAT(pose_.translation(), Point2Near(Point2(-1.0, 1.0), 0.15));
}

TEST_F(Drive, GoesToItsGoalWhenNothingLeadsOn) {
  ASSERT_TRUE(driver_.start(input(), {0, 0}));
  EXPECT_FALSE(driver_.go_on(input(), {20.0, 0.0}));
  EXPECT_FALSE(driver_.passes_through());
  while (tick() == DriveState::kDriving) {
  }
  EXPECT_EQ(step_.state, DriveState::kArrived);
  EXPECT_THAT(pose_.translation(), Point2Near(Point2(0.0, 0.0), 0.15));
}

TEST_F(Drive, GoesThroughWhereTheGoalIsInTheCorrectedMap) {
  ASSERT_TRUE(driver_.start(input(), {0, 0}));
  (void)tick();
  ASSERT_TRUE(driver_.go_on(input(), {2.0, 0.0}));
  const MapMove move{Pose2{0.0, 0.3, 0.0}};
  driver_.transform(move);
  pose_ = move * pose_;
  double nearest_m = 1.0;
  while (driver_.passes_through() && tick() == DriveState::kDriving) {
    nearest_m = std::min(nearest_m, (pose_.translation() - Point2(0.0, 0.3)).norm());
  }
  EXPECT_FALSE(driver_.passes_through());
  EXPECT_LT(nearest_m, 0.15);
}

}  // namespace
}  // namespace seeker::nav
