#include "server/nav/seen_movers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "common/core/rng.hpp"

namespace seeker::nav {
namespace {

constexpr double kDt_s = 0.1;
constexpr double kBodyRadius_m = 0.25;

/// A square hall about the origin, one round body and pieces of wall in it.
struct Hall {
  double half_m = 5.0;
  std::optional<Point2> body;
  std::vector<std::pair<Point2, Point2>> walls;

  [[nodiscard]] double range_m(const Point2& from, const Point2& along) const {
    double range_m = 1e9;
    for (int axis = 0; axis < 2; ++axis) {
      if (std::abs(along[axis]) > 1e-9) {
        range_m = std::min(range_m, (std::copysign(half_m, along[axis]) - from[axis]) / along[axis]);
      }
    }
    if (body) {
      const Point2 to_body = *body - from;
      const double ahead_m = to_body.dot(along);
      const double beside2 = to_body.squaredNorm() - ahead_m * ahead_m;
      if (ahead_m > 0.0 && beside2 < kBodyRadius_m * kBodyRadius_m) {
        range_m = std::min(range_m, ahead_m - std::sqrt(kBodyRadius_m * kBodyRadius_m - beside2));
      }
    }
    for (const auto& [start, end] : walls) {
      const Point2 wall = end - start;
      const double across = along.x() * wall.y() - along.y() * wall.x();
      const Point2 to_start = start - from;
      const double wall_m = (to_start.x() * wall.y() - to_start.y() * wall.x()) / across;
      const double share = (to_start.x() * along.y() - to_start.y() * along.x()) / across;
      if (wall_m > 0.0 && share >= 0.0 && share <= 1.0) {
        range_m = std::min(range_m, wall_m);
      }
    }
    return range_m;
  }

  /// Of a laser of 180 degrees with errors of 1 cm.
  [[nodiscard]] LaserScan scan(const Pose2& odom_T_base, Rng& rng) const {
    LaserScan scan;
    scan.angle_min_rad = -kPi / 2;
    scan.angle_step_rad = deg_to_rad(0.5);
    scan.range_max_m = 20.0;
    for (std::size_t beam = 0; beam <= 360; ++beam) {
      const double angle_rad = odom_T_base.theta_rad + scan.angle_rad(beam);
      const double exact_m = range_m(odom_T_base.translation(), {std::cos(angle_rad), std::sin(angle_rad)});
      scan.ranges_m.push_back(static_cast<float>(exact_m + rng.normal(0.01)));
    }
    return scan;
  }
};

RobotTime at(int tick) { return RobotTime{} + seconds(tick * kDt_s); }

TEST(SeenMovers, OneThatDrivesIsSeenWithItsVelocityFromARobotThatDrivesToo) {
  Rng rng(3);
  Hall hall;
  SeenMovers seen;
  const Twist2 own{0.4, 0.3};
  Pose2 odom_T_base{-3.0, -1.0, 0.0};
  Pose2 odom_T_body{2.0, 0.5, kPi};
  for (int tick = 0; tick < 10; ++tick) {
    hall.body = odom_T_body.translation();
    seen.look(hall.scan(odom_T_base, rng), odom_T_base, at(tick));
    const auto movers = seen.movers_base(odom_T_base, at(tick));
    if (tick >= 4) {
      ASSERT_EQ(movers.size(), 1U) << tick;
      const Pose2 odom_T_mover = odom_T_base * movers.front().frame_T_base;
      EXPECT_LT(distance_m(odom_T_mover, odom_T_body), 0.06);
      EXPECT_NEAR(wrap_angle(odom_T_mover.theta_rad - kPi), 0.0, 0.15);
      EXPECT_NEAR(movers.front().velocity.v_m_s, 0.5, 0.1);  // 2 cm over 0.4 s
    }
    odom_T_base = odom_T_base * integrate(own, kDt_s);
    odom_T_body = odom_T_body * integrate({0.5, 0.0}, kDt_s);
  }
}

TEST(SeenMovers, PillarsAndWallsThatARobotPassesStand) {
  Rng rng(4);
  Hall hall;
  hall.body = Point2(0.0, 0.8);
  SeenMovers seen;
  Pose2 odom_T_base{-3.0, 0.0, 0.0};
  for (int tick = 0; tick < 120; ++tick) {
    seen.look(hall.scan(odom_T_base, rng), odom_T_base, at(tick));
    EXPECT_TRUE(seen.movers_base(odom_T_base, at(tick)).empty()) << tick;
    odom_T_base = odom_T_base * integrate({0.5, tick < 60 ? 0.0 : 0.8}, kDt_s);
  }
}

/// Ends of walls as beside doors: from another place one sees more of them, or another side.
TEST(SeenMovers, EndsOfWallsThatARobotDrivesPastStand) {
  Rng rng(9);
  for (int drive = 0; drive < 100; ++drive) {
    Hall hall;
    const double length_m = rng.uniform(0.2, 1.0);
    hall.walls = {{{0.0, -0.05}, {length_m, -0.05}},
                  {{0.0, 0.05}, {length_m, 0.05}},
                  {{0.0, -0.05}, {0.0, 0.05}},
                  {{length_m, -0.05}, {length_m, 0.05}}};
    SeenMovers seen;
    Pose2 odom_T_base{rng.uniform(-0.8, -0.4), rng.uniform(-1.5, -0.5), rng.uniform(1.2, 1.9)};
    const Twist2 velocity{rng.uniform(0.1, 0.5), rng.uniform(-0.3, 0.3)};
    for (int tick = 0; tick < 50; ++tick) {
      seen.look(hall.scan(odom_T_base, rng), odom_T_base, at(tick));
      ASSERT_TRUE(seen.movers_base(odom_T_base, at(tick)).empty()) << "drive " << drive << ", tick " << tick;
      odom_T_base = odom_T_base * integrate(velocity, kDt_s);
    }
  }
}

TEST(SeenMovers, OneThatHasStoppedIsAMoverForAWhile) {
  Rng rng(8);
  Hall hall;
  const Pose2 odom_T_base{};
  const auto drives_then_stands = [&](int ticks) {
    SeenMovers seen;
    for (int tick = 0; tick < ticks; ++tick) {
      hall.body = Point2(3.0, -1.0 + 0.05 * std::min(tick, 8));
      seen.look(hall.scan(odom_T_base, rng), odom_T_base, at(tick));
    }
    return seen.movers_base(odom_T_base, at(ticks - 1));
  };
  const auto movers = drives_then_stands(40);
  ASSERT_EQ(movers.size(), 1U);
  EXPECT_LT(movers.front().velocity.v_m_s, 0.06);
  EXPECT_LT((movers.front().frame_T_base.translation() - *hall.body).norm(), 0.06);
  EXPECT_TRUE(drives_then_stands(200).empty());
}

TEST(SeenMovers, OneThatHasGoneOutOfSightIsForgotten) {
  Rng rng(5);
  Hall hall;
  SeenMovers seen;
  const Pose2 odom_T_base{};
  for (int tick = 0; tick < 8; ++tick) {
    hall.body = Point2(3.0, -2.0 + 0.05 * tick);
    seen.look(hall.scan(odom_T_base, rng), odom_T_base, at(tick));
  }
  EXPECT_FALSE(seen.movers_base(odom_T_base, at(8)).empty());
  hall.body.reset();
  seen.look(hall.scan(odom_T_base, rng), odom_T_base, at(12));
  EXPECT_TRUE(seen.movers_base(odom_T_base, at(12)).empty());
}

TEST(SeenMovers, WhatTheEdgeOfTheScanCutsOrAWallJoinsIsNoBody) {
  Rng rng(6);
  Hall hall;
  hall.body = Point2(2.0, 0.0);
  ASSERT_EQ(free_bodies(hall.scan({}, rng)).size(), 1U);
  EXPECT_NEAR(free_bodies(hall.scan({}, rng)).front().radius_m, kBodyRadius_m, 0.05);
  hall.body = Point2(0.0, 2.0);  // half of it is out of sight
  EXPECT_TRUE(free_bodies(hall.scan({}, rng)).empty());
  hall.body = Point2(5.0, 0.0);  // half of it is in the wall
  EXPECT_TRUE(free_bodies(hall.scan({}, rng)).empty());
}

TEST(SeenMovers, ABodyIsOneThoughABeamIsLost) {
  Rng rng(7);
  Hall hall;
  hall.body = Point2(2.0, 0.0);
  LaserScan scan = hall.scan({}, rng);
  scan.ranges_m[180] = std::numeric_limits<float>::infinity();
  ASSERT_EQ(free_bodies(scan).size(), 1U);
  EXPECT_NEAR(free_bodies(scan).front().radius_m, kBodyRadius_m, 0.05);
}

}  // namespace
}  // namespace seeker::nav
