#include "server/nav/movers.hpp"

#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "round_scan.hpp"
#include "server/nav/floor_view.hpp"
#include "server/nav/planned_driver.hpp"

namespace seeker::nav {
namespace {

constexpr double kDt_s = 0.1;

Mover mover_at(double x_m, double y_m, double theta_rad, double v_m_s) {
  Mover mover;
  mover.frame_T_base = {x_m, y_m, theta_rad};
  mover.velocity = {v_m_s, 0.0};
  return mover;
}

/// A base that brakes and speeds up as the clearances expect, and no faster.
struct Body {
  Pose2 map_T_base;
  Twist2 velocity;

  void step(const Twist2& wanted, const ClearanceParams& params) {
    const double change = params.decel_m_s2 * kDt_s;
    velocity.v_m_s += std::clamp(wanted.v_m_s - velocity.v_m_s, -change, change);
    velocity.omega_rad_s = wanted.omega_rad_s;
    map_T_base = map_T_base * integrate(velocity, kDt_s);
  }
  [[nodiscard]] Mover as_mover() const { return {map_T_base, velocity, 0.26, 0.0}; }
};

/// Both want to drive on as they do; the smallest distance of their centres.
double meet(Body a, Body b) {
  const ClearanceParams params;
  const Twist2 a_wants = a.velocity;
  const Twist2 b_wants = b.velocity;
  double nearest_m = 1e9;
  for (int k = 0; k < 200; ++k) {
    const auto around_a = moved({b.as_mover()}, inverse(a.map_T_base));
    const auto around_b = moved({a.as_mover()}, inverse(b.map_T_base));
    const Twist2 a_may = limit_for_movers(a_wants, a.velocity, around_a, params);
    const Twist2 b_may = limit_for_movers(b_wants, b.velocity, around_b, params);
    a.step(a_may, params);
    b.step(b_may, params);
    nearest_m = std::min(nearest_m, distance_m(a.map_T_base, b.map_T_base));
    if (a.velocity.v_m_s < 0.02 || b.velocity.v_m_s < 0.02) {
      break;  // what stands still is seen by the sensors
    }
  }
  return nearest_m;
}

TEST(Movers, TwoThatDriveTowardsEachOtherStopApart) {
  EXPECT_GE(meet({{0, 0, 0}, {0.5, 0}}, {{4, 0, kPi}, {0.5, 0}}), 0.50);
  EXPECT_GE(meet({{0, 0, 0}, {0.5, 0}}, {{4, 0.3, kPi}, {0.5, 0}}), 0.50);
}

TEST(Movers, TwoThatCrossDoNotTouch) {
  EXPECT_GE(meet({{0, 0, 0}, {0.5, 0}}, {{2, -2, kPi / 2}, {0.5, 0}}), 0.50);
  EXPECT_GE(meet({{0, 0, 0}, {0.5, 0.2}}, {{2, 0.5, kPi}, {0.4, 0.1}}), 0.50);
}

TEST(Movers, OneThatDrivesAwayOrPassesFarOffIsNoReasonToBrake) {
  const Twist2 wanted{0.5, 0.1};
  const ClearanceParams params;
  EXPECT_EQ(limit_for_movers(wanted, wanted, {mover_at(1.0, 0, 0, 0.5)}, params), wanted);
  EXPECT_EQ(limit_for_movers(wanted, wanted, {mover_at(3.0, 3.0, kPi, 0.5)}, params), wanted);
  EXPECT_EQ(limit_for_movers(wanted, wanted, {}, params), wanted);
}

TEST(Movers, AtSpeedOneIsSlowedWhateverTheWheelsSayOfTheLastMillimetre) {
  const Twist2 wanted{0.5, 0.0};
  for (const double present_m_s : {0.4999, 0.5, 0.5001}) {
    const Twist2 may = limit_for_movers(wanted, {present_m_s, 0.0}, {mover_at(1.2, 0.3, -2.5, 0.5)}, {});
    EXPECT_LT(may.v_m_s, wanted.v_m_s) << present_m_s;
  }
}

TEST(Movers, OneThatStandsIsLeftToTheSensors) {
  const Twist2 wanted{0.5, 0.0};
  EXPECT_EQ(limit_for_movers(wanted, wanted, {mover_at(0.6, 0, 0, 0.0)}, {}), wanted);
}

TEST(Movers, DrivingOnIsTheWayOutBeforeOneThatComesFromBehind) {
  const Twist2 wanted{0.4, 0.0};
  EXPECT_EQ(limit_for_movers(wanted, {0.3, 0.0}, {mover_at(-0.6, 0, 0, 0.5)}, {}), wanted);
}

TEST(Movers, BeamsThatEndAtOneAreUnusableAndNoOthers) {
  LaserScan scan;
  scan.angle_min_rad = -0.2;
  scan.angle_step_rad = 0.1;
  scan.range_max_m = 10.0;
  scan.ranges_m = {4.0F, 4.0F, 1.75F, 4.0F, kNoReturn};
  const Pose2 map_T_base{1.0, 2.0, kPi / 2};
  Mover mover = mover_at(1.0, 4.0, 0.0, 0.0);
  const LaserScan masked = without_movers(scan, map_T_base, {mover});
  EXPECT_EQ(masked.quality, (std::vector<std::uint8_t>{1, 1, 0, 1, 1}));
  EXPECT_EQ(masked.ranges_m, scan.ranges_m);
  mover.frame_T_base.x_m = 3.0;
  EXPECT_EQ(without_movers(scan, map_T_base, {mover}), scan);
}

/// Free floor of 6 x 6 m about the origin.
OccupancyMap open_floor() {
  OccupancyMap map;
  const LaserScan scan = round_scan(3.0F);
  for (int k = 0; k < 4; ++k) {
    EXPECT_TRUE(map.integrate(scan, {}));
  }
  return map;
}

TEST(Movers, WaysArePlannedAroundThoseThatAreNear) {
  const OccupancyMap map = open_floor();
  FloorSource floors({}, {}, 0.25, 1.0);
  floors.attend(map, {-1.5, 0, 0}, RobotTime{}, {mover_at(0, 0, 0, 0.3)});
  const auto view = floors.view();
  ASSERT_TRUE(view);
  EXPECT_TRUE((*view)->cost.traversable(Point2(0, 0)));
  const auto costs = floors.around_movers(**view);
  ASSERT_TRUE(costs);
  EXPECT_FALSE(costs->traversable(Point2(0, 0)));
  EXPECT_TRUE(costs->traversable(Point2(0, 0.7)));
  floors.attend(map, {-1.5, 0, 0}, RobotTime{}, {mover_at(2.0, 0, 0, 0.3)});
  EXPECT_FALSE(floors.around_movers(**view));
}

TEST(Movers, WaysLeadUpToOneThatCoversTheGoalAndAwayFromOneThatIsTooNear) {
  const OccupancyMap map = open_floor();
  FloorSource floors({}, {}, 0.25, 1.0);
  PlannedDriver driver{{}};
  const Pose2 map_T_base{-1.5, 0, 0};
  floors.attend(map, map_T_base, RobotTime{}, {mover_at(0.5, 0, 0, 0.0)});
  ASSERT_TRUE(driver.start({RobotTime{}, map_T_base, nullptr, nullptr, floors}, {0.5, 0})) << driver.reason();
  EXPECT_EQ(driver.path().back(), Point2(0.5, 0));
  // 0.4 m beside it, where the two discs touch nearly: a wall of that size would hold the robot fast.
  floors.attend(map, map_T_base, RobotTime{}, {mover_at(-1.5, 0.4, 0, 0.0)});
  ASSERT_TRUE(driver.start({RobotTime{}, map_T_base, nullptr, nullptr, floors}, {1.0, 0})) << driver.reason();
  for (const Point2& p : driver.path()) {
    EXPECT_GE((p - Point2(-1.5, 0.4)).norm(), 0.3);
  }
}

TEST(Movers, AreNeverKeptAsObstacles) {
  const OccupancyMap map = open_floor();
  FloorSource floors({}, {}, 0.25, 1.0);
  floors.attend(map, {-1.5, 0, 0}, RobotTime{}, {mover_at(0, 0, 0, 0.3)});
  floors.add_obstacle({0.2, 0.0});
  EXPECT_TRUE((*floors.view(true))->cost.traversable(Point2(0, 0)));
  floors.add_obstacle({0.0, 0.5});
  EXPECT_FALSE((*floors.view(true))->cost.traversable(Point2(0, 0.5)));
}

TEST(FloorSource, ForgetsAnObstacleThatWasNotMetForAMinute) {
  const OccupancyMap map = open_floor();
  FloorSource floors({}, {}, 0.25, 1.0);
  const auto at = [&](double t_s) { floors.attend(map, {-1.5, 0, 0}, RobotTime{} + seconds(t_s)); };
  const auto is_free = [&] { return (*floors.view(true))->cost.traversable(Point2(0, 0.5)); };
  at(0.0);
  EXPECT_TRUE(is_free());
  floors.add_obstacle({0.0, 0.5});
  at(50.0);
  floors.add_obstacle({0.05, 0.5});  // met again
  at(100.0);
  EXPECT_FALSE(is_free());
  at(111.0);
  EXPECT_TRUE(is_free());
}

TEST(FloorSource, HasRoomForANewObstacleHoweverManyThereAre) {
  const OccupancyMap map = open_floor();
  FloorSource floors({}, {}, 0.25, 1.0);
  for (int k = 0; k < 400; ++k) {
    floors.attend(map, {-1.5, 0, 0}, RobotTime{} + seconds(0.01 * k));
    floors.add_obstacle({0.12 * (k % 20) + 50.0, 0.12 * (k / 20)});
  }
  floors.add_obstacle({0.0, 0.5});
  EXPECT_FALSE((*floors.view(true))->cost.traversable(Point2(0, 0.5)));
}

}  // namespace
}  // namespace seeker::nav
