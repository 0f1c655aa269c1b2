/// \file
/// A tiny kinematic world for closed-loop tests of the search: walls as segments, perfect odometry, sonars, lidar, and
/// a recogniser that sees targets in range and in the line of sight.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "common/core/angle.hpp"
#include "common/core/polygon.hpp"
#include "common/core/rng.hpp"
#include "server/nav/occupancy_map.hpp"
#include "server/search/search_mission.hpp"

namespace seeker::search {

using Wall = std::pair<Point2, Point2>;

inline std::vector<Wall> box(double x0, double y0, double x1, double y1) {
  return {{{x0, y0}, {x1, y0}}, {{x1, y0}, {x1, y1}}, {{x1, y1}, {x0, y1}}, {{x0, y1}, {x0, y0}}};
}

struct ToyWorld {
  std::vector<Wall> walls;
  std::optional<Point2> target;  ///< a disc of radius 0.15 m, solid
  double recognise_range_m = 2.5;
  double recognise_from_m = 0.0;  ///< nearer it is not recognised: a mistake of the recogniser looks like that
  double recognise_rate = 0.9;

  [[nodiscard]] double ray(const Point2& from, double heading_rad, double max_m) const {
    const Point2 d(std::cos(heading_rad), std::sin(heading_rad));
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
    for (const auto& [a, b] : walls) {
      nearest = std::min(nearest, distance_to_segment_m(a, b, p));
    }
    return nearest;
  }
};

/// What a closed-loop run left behind.
struct ToyRun {
  std::optional<SearchEnd> end;
  std::vector<SearchEvent> events;
  std::vector<Detection> detections;
  CoverageSummary summary;
  GridLists lists;
  double path_m = 0.0;
  double seconds = 0.0;
  double least_clearance_m = 100.0;
  Pose2 pose;
  int images = 0;
  bool left_bound = false;
};

class ToyRobot {
 public:
  ToyRobot(ToyWorld world, Pose2 start, bool laser, std::uint64_t seed)
      : world_(std::move(world)), pose_(start), laser_fitted_(laser), rng_(seed) {}

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
        range = std::min(range, world_.ray(at.translation(), at.theta_rad + deg_to_rad(3.0 * ray), 5.0));
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
    scan.range_max_m = 8.0;
    for (int k = 0; k <= 180; ++k) {
      const double angle = pose_.theta_rad + scan.angle_rad(static_cast<std::size_t>(k));
      const double range = world_.ray(pose_.translation(), angle, 8.0);
      scan.ranges_m.push_back(range < 8.0 ? static_cast<float>(std::max(0.01, range + rng_.normal(0.01))) : kNoReturn);
    }
    return scan;
  }

  [[nodiscard]] std::vector<vision::Sighting> recognise() {
    if (!world_.target) {
      return {};
    }
    const Point2 to = *world_.target - pose_.translation();
    const double heading = std::atan2(to.y(), to.x());
    const bool clear = world_.ray(pose_.translation(), heading, 10.0) > to.norm() - 0.2;
    if (!clear || to.norm() > world_.recognise_range_m || to.norm() < world_.recognise_from_m ||
        rng_.uniform() > world_.recognise_rate) {
      return {};
    }
    vision::Sighting sighting;
    sighting.score = 0.8;
    sighting.bearing_base_rad = wrap_angle(heading - pose_.theta_rad + rng_.normal(0.02));
    return {sighting};
  }

  /// Moves with the acceleration limits of a Pioneer.
  void drive(const Twist2& command) {
    constexpr double kTick_s = 0.1;
    const double dv = std::clamp(command.v_m_s - twist_.v_m_s, -0.03, 0.03);
    const double dw = std::clamp(command.omega_rad_s - twist_.omega_rad_s, -0.1745, 0.1745);
    twist_ = {twist_.v_m_s + dv, twist_.omega_rad_s + dw};
    pose_ = pose_ * integrate(twist_, kTick_s);
  }

  ToyRun run(SearchMission& mission, double limit_s, const std::optional<Polygon>& bound = {}) {
    ToyRun out;
    nav::OccupancyMap map;
    for (int tick = 0; tick * 0.1 < limit_s; ++tick) {
      const RobotTime now = robot_time_s(tick * 0.1);
      const SonarScan sonar_scan = sonar(now);
      const LaserScan laser_scan = laser(now);
      if (laser_fitted_) {
        (void)map.integrate(laser_scan, pose_);
      } else {
        (void)map.integrate(sonar_scan, pose_);
      }
      const LaserScan* laser_or_none = laser_fitted_ ? &laser_scan : nullptr;
      SearchStep step = mission.step({now, pose_, Matrix3::Identity() * 1e-6, &sonar_scan, laser_or_none, map, 0});
      out.events.insert(out.events.end(), step.events.begin(), step.events.end());
      out.seconds = to_seconds(now);
      if (step.end) {
        out.end = step.end;
        break;
      }
      if (step.wants_image) {
        ++out.images;
        mission.on_sightings(now, pose_, recognise(), laser_or_none, &sonar_scan);
      }
      drive(step.command);
      out.least_clearance_m = std::min(out.least_clearance_m, world_.clearance(pose_.translation()));
      out.left_bound = out.left_bound || (bound && !contains(*bound, pose_.translation()));
    }
    out.detections = mission.detections();
    out.summary = mission.summary();
    out.lists = mission.lists();
    out.path_m = mission.path_length_m();
    out.pose = pose_;
    return out;
  }

 private:
  ToyWorld world_;
  Pose2 pose_;
  Twist2 twist_;
  bool laser_fitted_;
  Rng rng_;
};

inline std::shared_ptr<const ControlTable> shared_table() {
  static const auto table = std::make_shared<const ControlTable>(*ControlTable::create());
  return table;
}

}  // namespace seeker::search
