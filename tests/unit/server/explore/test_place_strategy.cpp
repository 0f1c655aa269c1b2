// Drives from place to place: what happens where one of them is not reached, and where the last one is seen on the way.

#include <memory>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "server/explore/place_strategy.hpp"
#include "server/nav/occupancy_map.hpp"
#include "tests/support/matchers.hpp"
#include "tests/unit/server/nav/round_scan.hpp"

namespace seeker::explore {
namespace {

using seeker::testing::Point2Near;

constexpr double kTick_s = 0.1;
const Point2 kVia(1.5, 0.0);

/// Always the nearest opening, by `via_map` where it is given.
class NearestChooser final : public PlaceChooser {
 public:
  NearestChooser(const std::optional<Point2>& via_map, bool flowing) : via_map_(via_map), flowing_(flowing) {}

  [[nodiscard]] PlaceChoice choose(const PlaceInput& input) override {
    PlaceChoice choice;
    choice.opening = input.openings.front();
    choice.via_map = via_map_;
    return choice;
  }
  [[nodiscard]] bool wants_wall_ends() const override { return false; }
  [[nodiscard]] bool changes_its_mind() const override { return false; }
  [[nodiscard]] std::optional<DriveManner> manner() const override { return DriveManner{flowing_, 0.5 * kTick_s, 1.0}; }

 private:
  std::optional<Point2> via_map_;
  bool flowing_;
};

/// A robot amid free floor that ends in the unknown, 4 m away on every side.
class Amid {
 public:
  Amid(const ExploreParams& params, const std::optional<Point2>& via_map, bool flowing)
      : strategy_(params, std::make_unique<NearestChooser>(via_map, flowing)) {
    look_round(kNoReturn);
  }

  /// A few sweeps from where the robot began.
  void look_round(float range_m) {
    for (int sweep = 0; sweep < 3; ++sweep) {
      ASSERT_TRUE(map_.integrate(nav::round_scan(range_m), {}));
    }
  }

  StrategyStep step() {
    const RobotTime now = robot_time_s(kTick_s * ticks_++);
    floors_.attend(map_, pose, now);
    return strategy_.step({{now, pose, nullptr, nullptr, floors_}, {}, Matrix3::Zero(), none_, 1, {}});
  }

  Pose2 pose;

 private:
  PlaceStrategy strategy_;
  nav::OccupancyMap map_;
  nav::FloorSource floors_{{}, {}, 0.2, 0.0};
  std::vector<MapSegment> none_;
  int ticks_ = 0;
};

TEST(PlaceStrategy, APlaceBeforeTheGoalThatIsNotReachedIsLeftOut) {
  ExploreParams params;
  params.driver.goal_time_s = 2.0;
  Amid robot(params, kVia, false);
  StrategyStep step = robot.step();
  ASSERT_FALSE(step.planned_path.empty()) << step.activity;
  EXPECT_THAT(step.planned_path.back(), Point2Near(kVia, 0.1));
  for (int tick = 0; tick < 30; ++tick) {  // the robot does not move
    step = robot.step();
    EXPECT_EQ(step.activity.rfind("driving to observe", 0), 0U) << step.activity;
  }
  ASSERT_FALSE(step.planned_path.empty());
  EXPECT_GT((step.planned_path.back() - kVia).norm(), 1.0) << "on to the goal";
}

TEST(PlaceStrategy, StandsAsSoonAsNothingIsLeft) {
  Amid robot({}, std::nullopt, true);
  StrategyStep step;
  const auto drives = [&] { return robot.pose.translation().norm() > 1.0 && step.command.v_m_s > 0.1; };
  for (int tick = 0; tick < 200 && !drives(); ++tick) {
    step = robot.step();
    robot.pose = robot.pose * integrate(step.command, kTick_s);
  }
  ASSERT_TRUE(drives()) << step.activity;
  robot.look_round(5.0F);  // walls all around
  step = robot.step();
  ASSERT_TRUE(step.done) << step.activity;
  EXPECT_EQ(step.command.v_m_s, 0.0);
  EXPECT_EQ(step.command.omega_rad_s, 0.0);
}

}  // namespace
}  // namespace seeker::explore
