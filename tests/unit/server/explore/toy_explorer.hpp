/// \file
/// The toy world for closed-loop tests of exploration: occupancy from the laser, and a mapper of walls that knows them
/// and keeps the part of each that was hit.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "server/explore/exploration.hpp"
#include "server/nav/occupancy_map.hpp"
#include "tests/support/toy_world.hpp"

namespace seeker::explore {

using seeker::testing::box;
using seeker::testing::ToyWorld;
using seeker::testing::Wall;

inline std::vector<Wall> joined(std::vector<Wall> a, const std::vector<Wall>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// The parts of known walls that laser returns fell on; one segment each.
class ToyMapper {
 public:
  explicit ToyMapper(const std::vector<Wall>& walls) {
    for (const Wall& wall : walls) {
      parts_.push_back({wall, {}, Point2::Zero()});
    }
  }

  void note(const LaserScan& scan, const Pose2& map_T_base) {
    for (const Point2& p_base : points_in_base(scan)) {
      add(map_T_base * p_base, map_T_base.translation());
    }
  }

  [[nodiscard]] std::vector<MapSegment> segments() const {
    std::vector<MapSegment> all;
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      const Part& part = parts_[k];
      const double length = (part.wall.second - part.wall.first).norm();
      for (std::size_t n = 0; n < part.seen.size(); ++n) {
        const auto& [from, to] = part.seen[n];
        if (to - from >= kShortest_m) {
          all.push_back(segment_of(part, from, to, length, 1 + 100 * k + n));
        }
      }
    }
    return all;
  }

  /// Of the length of all walls, the part that is in segments.
  [[nodiscard]] double share() const {
    double total = 0.0;
    double seen = 0.0;
    for (const Part& part : parts_) {
      total += (part.wall.second - part.wall.first).norm();
    }
    for (const MapSegment& segment : segments()) {
      seen += segment.length_m;
    }
    return seen / total;
  }

 private:
  static constexpr double kGap_m = 0.3;
  static constexpr double kShortest_m = 0.3;
  static constexpr double kEnd_m = 0.08;

  struct Part {
    Wall wall;
    std::vector<std::pair<double, double>> seen;  ///< along the wall, in order, apart by more than kGap_m
    Point2 from;                                  ///< where it was seen from first
  };

  void add(const Point2& p, const Point2& from) {
    constexpr double kOnWall_m = 0.05;
    Part* best = nullptr;
    double best_m = kOnWall_m;
    for (Part& part : parts_) {
      if (const double d = distance_to_segment_m(part.wall.first, part.wall.second, p); d < best_m) {
        best = &part;
        best_m = d;
      }
    }
    if (best == nullptr) {
      return;
    }
    const Point2 along = (best->wall.second - best->wall.first).normalized();
    const double s = std::clamp(along.dot(p - best->wall.first), 0.0, (best->wall.second - best->wall.first).norm());
    if (best->seen.empty()) {
      best->from = from;
    }
    insert(best->seen, s);
  }

  static void insert(std::vector<std::pair<double, double>>& seen, double s) {
    seen.emplace_back(s, s);
    std::sort(seen.begin(), seen.end());
    std::size_t kept = 0;
    for (std::size_t k = 1; k < seen.size(); ++k) {
      if (seen[k].first <= seen[kept].second + kGap_m) {
        seen[kept].second = std::max(seen[kept].second, seen[k].second);
      } else {
        seen[++kept] = seen[k];
      }
    }
    seen.resize(kept + 1);
  }

  static MapSegment segment_of(const Part& part, double from, double to, double length, std::size_t id) {
    const Point2 along = (part.wall.second - part.wall.first).normalized();
    const Point2 middle = part.wall.first + 0.5 * (from + to) * along;
    const Point2 across(-along.y(), along.x());
    // y points away from where the robot stood.
    const bool flip = across.dot(part.from - middle) > 0.0;
    MapSegment segment;
    segment.id = id;
    segment.length_m = to - from;
    const bool first_real = from < kEnd_m;
    const bool second_real = to > length - kEnd_m;
    segment.left_real = flip ? second_real : first_real;
    segment.right_real = flip ? first_real : second_real;
    segment.map_T_segment = {middle.x(), middle.y(), wrap_angle(std::atan2(along.y(), along.x()) + (flip ? kPi : 0.0))};
    segment.covariance = Matrix2::Identity() * 1e-4;
    segment.hits = 10;
    return segment;
  }

  std::vector<Part> parts_;
};

/// What a closed-loop run left behind.
struct ToyRun {
  std::optional<ExploreEnd> end;
  std::vector<ExploreEvent> events;
  std::vector<ExploreDecision> decisions;
  std::vector<std::string> phases;  ///< in order, each change once
  double path_m = 0.0;
  double seconds = 0.0;
  double least_clearance_m = 100.0;
  double wall_share = 0.0;
  double progress = 0.0;
  Pose2 pose;
  std::size_t segments = 0;
};

class ToyExplorer : public seeker::testing::ToyBase {
 public:
  ToyExplorer(const ToyWorld& world, const Pose2& start, std::uint64_t seed, double laser_range_m = 8.0)
      : ToyBase(world, start, seed), mapper_(world.walls) {
    laser_range_m_ = laser_range_m;
  }

  /// What a test may change between two steps.
  struct Hooks {
    std::function<void(double t_s, ExploreInput& input)> input;             ///< the estimate, the battery
    std::function<void(double t_s, ToyWorld& world)> world;                 ///< people
    std::function<void(double t_s, Exploration& exploration)> exploration;  ///< pauses, moved maps
  };

  ToyRun run(Exploration& exploration, double limit_s, const Hooks& hooks = {}) {
    ToyRun out;
    for (int tick = 0; tick * kTick_s < limit_s; ++tick) {
      const double t_s = tick * kTick_s;
      if (hooks.world) {
        hooks.world(t_s, world_);
      }
      if (hooks.exploration) {
        hooks.exploration(t_s, exploration);
      }
      if (step(exploration, t_s, hooks, out)) {
        break;
      }
    }
    out.pose = pose_;
    out.wall_share = mapper_.share();
    out.segments = mapper_.segments().size();
    return out;
  }

  [[nodiscard]] const nav::OccupancyMap& map() const { return map_; }
  /// The map that the robot knows is the world moved by this; what was known moves along.
  void move_map(const Pose2& new_T_old) {
    map_T_world = new_T_old * map_T_world;
    map_.clear();
    for (const auto& [scan, world_T_base] : kept_) {
      (void)map_.integrate(scan, map_T_world * world_T_base);
    }
  }
  Pose2 map_T_world;

 private:
  static constexpr double kTick_s = 0.1;

  bool step(Exploration& exploration, double t_s, const Hooks& hooks, ToyRun& out) {
    const RobotTime now = robot_time_s(t_s);
    const SonarScan sonar_scan = sonar(now);
    const LaserScan laser_scan = laser(now);
    const Pose2 map_T_base = map_T_world * pose_;
    (void)map_.integrate(laser_scan, map_T_base);
    if (kept_.empty() || distance_m(kept_.back().second, pose_) > 0.2 ||
        std::abs(wrap_angle(kept_.back().second.theta_rad - pose_.theta_rad)) > 0.2) {
      kept_.emplace_back(laser_scan, pose_);
    }
    mapper_.note(laser_scan, pose_);
    std::vector<MapSegment> segments = mapper_.segments();
    for (MapSegment& segment : segments) {
      segment.map_T_segment = map_T_world * segment.map_T_segment;
    }
    PoseEstimate estimate;
    estimate.stamp = now;
    estimate.map_T_base = map_T_base;
    estimate.covariance = Matrix3::Identity() * 1e-6;
    estimate.quality = LocalisationQuality::kLocalised;
    ExploreInput input{now, estimate, twist_, &sonar_scan, &laser_scan, map_, segments, map_.revision(), {}, {}};
    if (hooks.input) {
      hooks.input(t_s, input);
    }
    note(exploration.step(input), t_s, out);
    return out.end.has_value();
  }

  void note(ExploreStep&& step, double t_s, ToyRun& out) {
    out.events.insert(out.events.end(), step.events.begin(), step.events.end());
    if (out.phases.empty() || out.phases.back() != step.phase) {
      out.phases.push_back(step.phase);
    }
    if (step.decision) {
      out.decisions.push_back(*step.decision);
    }
    out.end = step.end;
    out.seconds = t_s;
    out.progress = step.progress;
    const Point2 before = pose_.translation();
    drive(step.command);
    out.path_m += (pose_.translation() - before).norm();
    out.least_clearance_m = std::min(out.least_clearance_m, world_.clearance(pose_.translation()));
  }

  nav::OccupancyMap map_;
  std::vector<std::pair<LaserScan, Pose2>> kept_;
  ToyMapper mapper_;
};

}  // namespace seeker::explore
