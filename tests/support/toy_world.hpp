/// \file
/// A tiny kinematic world for closed-loop tests: walls as segments, perfect odometry, sonars and lidar.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "common/core/angle.hpp"
#include "common/core/polygon.hpp"
#include "common/core/rng.hpp"
#include "common/core/scan.hpp"

namespace seeker::testing {

using Wall = std::pair<Point2, Point2>;

inline std::vector<Wall> box(double x0, double y0, double x1, double y1) {
  return {{{x0, y0}, {x1, y0}}, {{x1, y0}, {x1, y1}}, {{x1, y1}, {x0, y1}}, {{x0, y1}, {x0, y0}}};
}

inline double ray_to_walls(const std::vector<Wall>& walls, const Point2& from, const Point2& d, double max_m) {
  double nearest = max_m;
  for (const auto& [a, b] : walls) {
    const Point2 e = b - a;
    const double cross = d.x() * e.y() - d.y() * e.x();
    if (std::abs(cross) < 1e-12) {
      continue;
    }
    const Point2 to = a - from;
    const double t = (to.x() * e.y() - to.y() * e.x()) / cross;
    const double s = (to.x() * d.y() - to.y() * d.x()) / cross;
    if (t >= 0.0 && s >= 0.0 && s <= 1.0) {
      nearest = std::min(nearest, t);
    }
  }
  return nearest;
}

struct ToyWorld {
  std::vector<Wall> walls;
  std::vector<Wall> low_things;  ///< below the laser's plane: only sonars see them
  std::optional<Point2> target;  ///< a disc of radius 0.15 m, solid

  /// Distance to the first thing at the laser's height; with `low` also to things below.
  [[nodiscard]] double ray(const Point2& from, double heading_rad, double max_m, bool low = false) const {
    const Point2 d(std::cos(heading_rad), std::sin(heading_rad));
    double nearest = ray_to_walls(walls, from, d, max_m);
    if (low) {
      nearest = ray_to_walls(low_things, from, d, nearest);
    }
    if (target) {
      constexpr double kRadius_m = 0.15;
      const Point2 to = *target - from;
      const double along = to.dot(d);
      const double across2 = to.squaredNorm() - along * along;
      if (along > 0.0 && across2 < kRadius_m * kRadius_m) {
        nearest = std::min(nearest, along - std::sqrt(kRadius_m * kRadius_m - across2));
      }
    }
    return nearest;
  }

  [[nodiscard]] double clearance(const Point2& p) const {
    double nearest = target ? (*target - p).norm() - 0.15 : 100.0;
    for (const auto* things : {&walls, &low_things}) {
      for (const auto& [a, b] : *things) {
        nearest = std::min(nearest, distance_to_segment_m(a, b, p));
      }
    }
    return nearest;
  }
};

/// A Pioneer with eight sonars and a laser of 180 degrees in a ToyWorld.
class ToyBase {
 public:
  ToyBase(ToyWorld world, Pose2 start, std::uint64_t seed) : world_(std::move(world)), pose_(start), rng_(seed) {}

  [[nodiscard]] SonarScan sonar(RobotTime now) {
    constexpr std::array<double, 8> kHeadings_deg{90, 50, 30, 10, -10, -30, -50, -90};
    SonarScan scan;
    scan.stamp = now;
    scan.range_max_m = 5.0;
    scan.cone_half_angle_rad = deg_to_rad(12.0);
    for (const double heading_deg : kHeadings_deg) {
      const double h = deg_to_rad(heading_deg);
      const Pose2 mount{0.16 * std::cos(h), 0.14 * std::sin(h), h};
      const Pose2 at = pose_ * mount;
      double range = 5.0;
      for (int ray = -4; ray <= 4; ++ray) {
        range = std::min(range, world_.ray(at.translation(), at.theta_rad + deg_to_rad(3.0 * ray), 5.0, true));
      }
      scan.readings.push_back({mount, range < 5.0 ? static_cast<float>(range + rng_.normal(0.01)) : kNoReturn});
    }
    for (SonarReading& reading : scan.readings) {
      reading.range_m = std::max(reading.range_m, 0.0F);
    }
    return scan;
  }

  [[nodiscard]] LaserScan laser(RobotTime now) {
    LaserScan scan;
    scan.stamp = now;
    scan.angle_min_rad = -kPi / 2.0;
    scan.angle_step_rad = deg_to_rad(1.0);
    scan.range_max_m = laser_range_m_;
    for (int k = 0; k <= 180; ++k) {
      const double angle = pose_.theta_rad + scan.angle_rad(static_cast<std::size_t>(k));
      const double range = world_.ray(pose_.translation(), angle, laser_range_m_);
      scan.ranges_m.push_back(range < laser_range_m_ ? static_cast<float>(std::max(0.01, range + rng_.normal(0.01)))
                                                     : kNoReturn);
    }
    return scan;
  }

  /// Moves with the acceleration limits of a Pioneer.
  void drive(const Twist2& command) {
    constexpr double kTick_s = 0.1;
    const double dv = std::clamp(command.v_m_s - twist_.v_m_s, -0.03, 0.03);
    const double dw = std::clamp(command.omega_rad_s - twist_.omega_rad_s, -0.1745, 0.1745);
    twist_ = {twist_.v_m_s + dv, twist_.omega_rad_s + dw};
    pose_ = pose_ * integrate(twist_, kTick_s);
  }

  [[nodiscard]] const Pose2& pose() const { return pose_; }
  [[nodiscard]] const Twist2& twist() const { return twist_; }
  [[nodiscard]] ToyWorld& world() { return world_; }

 protected:
  ToyWorld world_;
  Pose2 pose_;
  Twist2 twist_;
  Rng rng_;
  double laser_range_m_ = 8.0;
};

}  // namespace seeker::testing
