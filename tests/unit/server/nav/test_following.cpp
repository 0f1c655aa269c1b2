#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "ascii_map.hpp"
#include "common/core/rng.hpp"
#include "server/nav/clearance.hpp"
#include "server/nav/path_follower.hpp"
#include "tests/support/matchers.hpp"

namespace seeker::nav {
namespace {

constexpr double kTick_s = 0.1;
constexpr double kBody_m = 0.25;

/// Rooms joined by doors of 0.9 m, with furniture.
Grid<std::uint8_t> flat() {
  std::vector<std::string> rows(60, '#' + std::string(98, '.') + '#');
  rows.front() = rows.back() = std::string(100, '#');
  const auto wall = [&](std::size_t x, std::size_t from, std::size_t to) {
    for (std::size_t j = from; j < to; ++j) {
      rows[j][x] = '#';
    }
  };
  wall(35, 1, 12);
  wall(35, 21, 59);
  wall(65, 1, 40);
  wall(65, 49, 59);
  for (std::size_t j = 25; j < 33; ++j) {
    std::fill_n(rows[j].begin() + 47, 8, '#');
  }
  return ascii_map(rows, 0.1);
}

/// A base that does what it is told, and its laser.
struct Robot {
  Grid<std::uint8_t> world;
  Pose2 pose;
  RobotTime now = robot_time_s(1.0);
  Twist2 last{};
  double nearest_m = 1e9;  ///< smallest distance from the centre to an occupied cell's border so far

  std::vector<Point2> see() const { return points_in_base(scan_in(world, pose)); }
  void move(const Twist2& twist) {
    pose = pose * integrate(twist, kTick_s);
    now += seconds(kTick_s);
    const GridFrame& f = world.frame();
    const CellIndex c = f.cell_of(pose.translation());
    for (int j = c.j - 8; j <= c.j + 8; ++j) {
      for (int i = c.i - 8; i <= c.i + 8; ++i) {
        if (world.contains({i, j}) && world[{i, j}] == kOccupiedCell) {
          const Point2 low = f.origin + f.resolution_m * Point2(i, j);
          const Point2 high = low + Point2::Constant(f.resolution_m);
          const Point2 p = pose.translation();
          nearest_m = std::min(nearest_m, (p - p.cwiseMax(low).cwiseMin(high)).norm());
        }
      }
    }
  }
};

FollowStep drive(Robot& robot, PathFollower& follower, int ticks) {
  FollowStep step;
  for (int k = 0; k < ticks; ++k) {
    step = follower.step(robot.pose, robot.see(), robot.now);
    EXPECT_LE(step.command.v_m_s - robot.last.v_m_s, 0.3 * kTick_s + 1e-9);
    EXPECT_LE(std::abs(step.command.v_m_s), 0.5 + 1e-9);
    robot.last = step.command;
    robot.move(step.command);
    if (step.state != FollowState::kFollowing) {
      break;
    }
  }
  return step;
}

TEST(PathFollower, PassesTwoDoorsWithoutContactAndArrives) {
  Robot robot{flat(), Pose2{1.0, 1.0, kPi}};
  const auto map = CostMap::build(robot.world);
  ASSERT_TRUE(map);
  const Point2 goal(9.0, 4.5);
  const auto path = plan(*map, robot.pose.translation(), goal);
  ASSERT_TRUE(path) << path.error().message;
  PathFollower follower;
  follower.set_path(*path, robot.now, -kPi / 2.0);
  const FollowStep end = drive(robot, follower, 1200);
  EXPECT_EQ(end.state, FollowState::kArrived) << end.reason << " at " << robot.pose;
  EXPECT_THAT(robot.pose.translation(), testing::Point2Near(goal, 0.13));
  EXPECT_NEAR(wrap_angle(robot.pose.theta_rad + kPi / 2.0), 0.0, 0.08);
  EXPECT_GT(robot.nearest_m, kBody_m);
  EXPECT_LT(to_seconds(robot.now), 1.0 + path->length_m / 0.5 * 2.0 + 10.0);
}

TEST(PathFollower, ReachesRandomGoalsWithoutContact) {
  Rng rng(20);
  Robot robot{flat(), Pose2{1.0, 1.0, 0.0}};
  const auto map = CostMap::build(robot.world);
  PathFollower follower;
  int goals = 0;
  while (goals < 12) {
    const Point2 goal(rng.uniform(0.5, 9.5), rng.uniform(0.5, 5.5));
    if (!map->traversable(goal)) {
      continue;
    }
    const auto path = plan(*map, robot.pose.translation(), goal);
    ASSERT_TRUE(path) << path.error().message;
    follower.set_path(*path, robot.now);
    const FollowStep end = drive(robot, follower, 1500);
    EXPECT_EQ(end.state, FollowState::kArrived) << "seed 20, goal " << goals << ": " << end.reason << robot.pose;
    ++goals;
  }
  EXPECT_GT(robot.nearest_m, kBody_m);
}

TEST(PathFollower, StopsBeforeAnObstacleThatAppearsAndReportsIt) {
  Robot robot{ascii_map(std::vector<std::string>(10, std::string(60, '.')), 0.1), Pose2{0.5, 0.5, 0.0}};
  PathFollower follower;
  follower.set_path(Path{{{0.5, 0.5}, {5.5, 0.5}}, 5.0, 5.0}, robot.now);
  drive(robot, follower, 30);
  const double x = robot.pose.x_m + 0.9;
  for (int j = 4; j < 16; ++j) {
    robot.world[robot.world.frame().cell_of({x, 0.05 * j})] = kOccupiedCell;
  }
  const FollowStep end = drive(robot, follower, 100);
  EXPECT_EQ(end.state, FollowState::kBlocked);
  EXPECT_FALSE(end.reason.empty());
  for (int k = 0; k < 20; ++k) {
    robot.move(follower.step(robot.pose, robot.see(), robot.now).command);
  }
  EXPECT_GT(robot.nearest_m, kBody_m);
}

TEST(PathFollower, PassesSlowlyWhatItWillNearlyTouch) {
  const auto speed_beside_m_s = [](double offset_m) {
    const FollowerParams params;
    Robot robot{ascii_map(std::vector<std::string>(20, std::string(60, '.')), 0.1), Pose2{0.5, 1.0, 0.0}};
    PathFollower follower(params);
    follower.set_path(Path{{{0.5, 1.0}, {5.5, 1.0}}, 5.0, 5.0}, robot.now);
    double beside_m_s = 0.0;
    while (robot.pose.x_m < 3.0) {
      const Point2 post_base = inverse(robot.pose) * Point2(3.0, 1.0 + params.clearance.radius_m + offset_m);
      beside_m_s = follower.step(robot.pose, {post_base}, robot.now).command.v_m_s;
      EXPECT_GT(beside_m_s, 0.0) << "at " << robot.pose;
      robot.move({beside_m_s, 0.0});
    }
    return beside_m_s;
  };
  const FollowerParams params;
  EXPECT_NEAR(speed_beside_m_s(0.02), params.near_miss_v_m_s, 1e-6);
  EXPECT_NEAR(speed_beside_m_s(params.near_miss_m + 0.02), params.max_v_m_s, 1e-6);
}

TEST(PathFollower, GoesOnAlongItsPathWhenTheMapMoves) {
  const Pose2 new_T_old{5.0, -3.0, 0.7};
  PathFollower still;
  PathFollower moved;
  const Path path{{{0.0, 0.0}, {2.0, 0.0}, {2.0, 2.0}}, 4.0, 4.0};
  still.set_path(path, robot_time_s(0.0), kPi);
  moved.set_path(path, robot_time_s(0.0), kPi);
  moved.transform(new_T_old);
  Pose2 pose;
  for (int tick = 1; tick < 400; ++tick) {
    const RobotTime now = robot_time_s(0.1 * tick);
    const FollowStep a = still.step(pose, {}, now);
    const FollowStep b = moved.step(new_T_old * pose, {}, now);
    ASSERT_EQ(a.state, b.state) << tick;
    ASSERT_NEAR(a.command.v_m_s, b.command.v_m_s, 1e-6) << tick;
    ASSERT_NEAR(a.command.omega_rad_s, b.command.omega_rad_s, 1e-6) << tick;
    if (a.state == FollowState::kArrived) {
      return;
    }
    pose = pose * Pose2{0.1 * a.command.v_m_s, 0.0, 0.1 * a.command.omega_rad_s};
  }
  FAIL() << "never arrived: " << pose;
}

TEST(PathFollower, WhereACutCornerLeavesNoRoomItFollowsThePathItself) {
  const Path path{{{0.0, 0.0}, {0.28, 0.0}, {1.03, 0.66}}, 1.28, 1.28};
  const Point2 corner_map(0.14, 0.265);  // beside the path, within the arc that leads to its second leg
  PathFollower follower;
  follower.set_path(path, robot_time_s(0.0));
  Pose2 map_T_base;
  FollowStep step;
  for (double t_s = 0.0; t_s < 20.0 && step.state != FollowState::kArrived; t_s += kTick_s) {
    step = follower.step(map_T_base, {inverse(map_T_base) * corner_map}, robot_time_s(t_s));
    ASSERT_NE(step.state, FollowState::kBlocked) << "after " << t_s << " s at " << map_T_base.x_m;
    map_T_base = map_T_base * integrate(step.command, kTick_s);
    ASSERT_GT((map_T_base.translation() - corner_map).norm(), kBody_m);
  }
  EXPECT_EQ(step.state, FollowState::kArrived);
}

TEST(PathFollower, SaysStuckWhenTheBaseDoesNotMove) {
  PathFollower follower;
  follower.set_path(Path{{{0.0, 0.0}, {3.0, 0.0}}, 3.0, 3.0}, robot_time_s(0.0));
  FollowStep step;
  int ticks = 0;
  while (step.state != FollowState::kStuck && ticks < 200) {
    step = follower.step(Pose2{}, {}, robot_time_s(0.1 * ++ticks));
  }
  EXPECT_EQ(step.state, FollowState::kStuck);
  EXPECT_NEAR(0.1 * ticks, 6.1, 0.3);
}

TEST(PathFollower, TurnsInPlaceToAHeading) {
  Robot robot{ascii_map(std::vector<std::string>(20, std::string(20, '.')), 0.1), Pose2{1.0, 1.0, 0.0}};
  PathFollower follower;
  follower.set_heading(robot.pose, 3.0, robot.now);
  EXPECT_EQ(drive(robot, follower, 100).state, FollowState::kArrived);
  EXPECT_THAT(robot.pose, testing::Pose2Near(Pose2{1.0, 1.0, 3.0}, 0.001, 0.08));
}

TEST(PathFollower, WithoutAPathItStandsAndWithoutAPoseItStops) {
  PathFollower follower;
  EXPECT_EQ(follower.step(Pose2{}, {}, robot_time_s(0.0)).state, FollowState::kIdle);
  follower.set_path(Path{{{0.0, 0.0}, {3.0, 0.0}}, 3.0, 3.0}, robot_time_s(0.0));
  const FollowStep step = follower.step(Pose2{NAN, 0.0, 0.0}, {}, robot_time_s(0.1));
  EXPECT_EQ(step.state, FollowState::kStuck);
  EXPECT_EQ(step.command, Twist2{});
}

TEST(Clearance, StraightAheadTheFreeWayEndsAtTheFootprint) {
  const ClearanceParams params;
  EXPECT_NEAR(free_arc_m({0.4, 0.0}, {{1.0, 0.0}}, params), 1.0 - params.radius_m, 1e-9);
  EXPECT_DOUBLE_EQ(free_arc_m({0.4, 0.0}, {{1.0, 0.3}, {-1.0, 0.0}}, params), params.horizon_m);
  EXPECT_NEAR(free_arc_m({-0.4, 0.0}, {{-1.0, 0.0}}, params), 1.0 - params.radius_m, 1e-9);
  EXPECT_DOUBLE_EQ(free_arc_m({0.0, 1.0}, {{0.2, 0.0}}, params), params.horizon_m);
}

TEST(Clearance, ABaseThatBrakesStaysOnTheArcThatWasFree) {
  // On its arc to the left it passes the wall ahead; ordered to stand and to turn right it would roll into it.
  const ClearanceParams params;
  const Twist2 present{0.35, 1.0};
  std::vector<Point2> wall_base;
  for (double y = -1.0; y <= 1.0; y += 0.02) {
    wall_base.emplace_back(0.34, y);
  }
  const Twist2 wanted{0.0, 0.6};
  const double wanted_room_m = free_arc_m({present.v_m_s, wanted.omega_rad_s}, wall_base, params);
  const Twist2 kept = keep_arc_while_braking(wanted, present, wall_base, params);
  EXPECT_EQ(kept.v_m_s, 0.0);
  EXPECT_GT(kept.omega_rad_s, wanted.omega_rad_s);
  EXPECT_LE(kept.omega_rad_s, present.omega_rad_s);
  EXPECT_GT(free_arc_m({present.v_m_s, kept.omega_rad_s}, wall_base, params), wanted_room_m);
  EXPECT_EQ(keep_arc_while_braking(wanted, present, {{3.0, 0.0}}, params), wanted) << "there is room";
  EXPECT_EQ(keep_arc_while_braking(wanted, {}, wall_base, params), wanted) << "it does not roll";
}

TEST(Clearance, NoRoomStopsButMayTurnAndMayLeave) {
  const Twist2 ahead{0.4, 0.2};
  EXPECT_EQ(limit_for_clearance(ahead, {{0.27, 0.0}}), (Twist2{0.0, 0.2}));
  EXPECT_EQ(limit_for_clearance(ahead, {{3.5, 0.0}}), ahead);
  EXPECT_EQ(limit_for_clearance({-0.4, 0.0}, {{0.2, 0.0}}), (Twist2{-0.4, 0.0}));
}

RC_GTEST_PROP(Clearance, FreeArcAgreesWithSteppingAlongIt, (std::uint32_t seed)) {
  Rng rng(seed);
  ClearanceParams params;
  const Twist2 twist{rng.uniform(-0.6, 0.6), rng.uniform(-1.5, 1.5)};
  RC_PRE(std::abs(twist.v_m_s) > 0.05);
  std::vector<Point2> points;
  for (int k = 0; k < 5; ++k) {
    const Point2 p(rng.uniform(-2.0, 2.0), rng.uniform(-2.0, 2.0));
    if (p.norm() > params.radius_m + 0.01) {
      points.push_back(p);
    }
  }
  const double full_circle_m = kTwoPi * std::abs(twist.v_m_s / twist.omega_rad_s);
  const double reach_m = std::min(params.horizon_m, full_circle_m);
  double stepped = params.horizon_m;
  for (double s = 0.0; s < reach_m && stepped == params.horizon_m; s += 0.001) {
    const Pose2 at = integrate(twist, s / std::abs(twist.v_m_s));
    for (const Point2& p : points) {
      stepped = (p - at.translation()).norm() < params.radius_m ? s : stepped;
    }
  }
  // A touch of the footprint's edge shorter than the step may be missed.
  RC_ASSERT(std::abs(free_arc_m(twist, points, params) - stepped) < 0.005 ||
            free_arc_m(twist, points, {params.radius_m - 1e-3}) > stepped - 0.06);
}

}  // namespace
}  // namespace seeker::nav
