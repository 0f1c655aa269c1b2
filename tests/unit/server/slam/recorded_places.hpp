/// \file
/// Maps and queries from recorded logs, for the tests and benchmarks of place recognition.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <vector>

#include <Eigen/LU>

#include "server/drivers/replay/replay.hpp"
#include "server/slam/loop_detector.hpp"
#include "server/slam/place_recogniser.hpp"
#include "server/slam/pose_graph.hpp"
#include "server/slam/scan_map_tracker.hpp"

namespace seeker::slam {

/// A log as the tracker sees it: every scan with its pose, and which of them made the map.
struct RecordedWalk {
  std::vector<Pose2> poses;
  std::vector<Pose2> tracked;  ///< as the tracker gave them
  std::vector<SeenPoints> seen_base;
  std::vector<bool> keyframe;
  std::vector<double> stamps_s;

  [[nodiscard]] std::vector<SeenPoints> map() const {
    std::vector<SeenPoints> scans;
    for (std::size_t k = 0; k < poses.size(); ++k) {
      if (keyframe[k]) {
        scans.push_back(transform(poses[k], seen_base[k]));
      }
    }
    return scans;
  }

  /// The scans over the last `travel_m` up to scan k, in its base's frame, put together by the tracker.
  [[nodiscard]] std::vector<SeenPoints> gathered(std::size_t k, double travel_m, double spacing_m = 0.3) const {
    std::vector<SeenPoints> scans{seen_base[k]};
    double travelled_m = 0.0;
    double since_m = 0.0;
    for (std::size_t i = k; i-- > 0 && travelled_m < travel_m;) {
      const double step_m = distance_m(tracked[i], tracked[i + 1]);
      travelled_m += step_m;
      since_m += step_m;
      if (since_m >= spacing_m) {
        scans.push_back(transform(inverse(tracked[k]) * tracked[i], seen_base[i]));
        since_m = 0.0;
      }
    }
    return scans;
  }
};

inline std::optional<RecordedWalk> walk_through(const std::filesystem::path& path,
                                                const drivers::ReplayParams& params = {}) {
  auto reader = drivers::CarmenReader::open(path);
  if (!reader) {
    return std::nullopt;
  }
  RecordedWalk walk;
  ScanMapTracker tracker;
  std::optional<double> first_s;
  std::size_t keyframes = 0;
  while (auto record = reader->next()) {
    const auto* scan = std::get_if<drivers::CarmenScan>(&*record);
    if (scan == nullptr || !scan->odom_T_base) {
      continue;
    }
    first_s = first_s.value_or(scan->stamp_s);
    const RobotTime stamp = robot_time_s(scan->stamp_s - *first_s);
    const LaserScan laser = drivers::to_laser_scan(*scan, params, stamp);
    (void)tracker.predict(*scan->odom_T_base, stamp);
    (void)tracker.update(laser);
    walk.poses.push_back(tracker.estimate().map_T_base);
    walk.stamps_s.push_back(scan->stamp_s);
    walk.tracked.push_back(walk.poses.back());
    walk.seen_base.push_back(seen_points(laser));
    walk.keyframe.push_back(tracker.keyframe_count() != keyframes);
    keyframes = tracker.keyframe_count();
  }
  return walk;
}

/// What close_loops() did.
struct ClosedLoops {
  std::size_t submaps = 0;
  std::size_t loops = 0;
  std::size_t switched_off = 0;
  double detect_s = 0.0;
};

/// Sub-maps of `length_m` of the walk, loops between them and a pose graph: takes the tracker's drift out of `walk`.
inline ClosedLoops close_loops(RecordedWalk& walk, double length_m = 4.0) {
  struct Submap {
    Pose2 tracked;  ///< pose of its first scan as the tracker gave it
    std::size_t first = 0;
    std::size_t last = 0;
    std::shared_ptr<const PlaceMap> place;
    std::vector<SeenPoints> seen;
  };
  std::vector<Submap> submaps;
  double travelled_m = length_m;
  for (std::size_t k = 0; k < walk.poses.size(); ++k) {
    travelled_m += k == 0 ? 0.0 : distance_m(walk.poses[k - 1], walk.poses[k]);
    if (travelled_m >= length_m) {
      submaps.push_back({walk.poses[k], k, k, nullptr, {}});
      travelled_m = 0.0;
    }
    submaps.back().last = k + 1;
    if (walk.keyframe[k] || walk.keyframe[k > 0 ? k - 1 : 0]) {
      submaps.back().seen.push_back(transform(inverse(submaps.back().tracked) * walk.poses[k], walk.seen_base[k]));
    }
  }
  ClosedLoops report;
  report.submaps = submaps.size();
  const Matrix3 step = Eigen::Vector3d(4e-3, 4e-3, 4e-4).asDiagonal();
  PoseGraph graph;
  PlaceMapParams params;
  params.pyramid.coarse_level = 2;
  const LoopDetector detector;
  for (std::size_t j = 0; j < submaps.size(); ++j) {
    if (j == 0) {
      graph.add_node(submaps[0].tracked);
    } else {
      const Pose2 moved = inverse(submaps[j - 1].tracked) * submaps[j].tracked;
      graph.add_node(graph.pose(j - 1) * moved);
      (void)graph.add_edge({j - 1, j, moved, step.inverse(), EdgeKernel::kNone, 0.0});
    }
    std::vector<LoopTarget> targets;
    for (std::size_t i = 0; i + 3 < j; ++i) {
      if (submaps[i].place && distance_m(graph.pose(i), graph.pose(j)) < 6.0) {
        targets.push_back(
            {i, submaps[i].place, {inverse(graph.pose(i)) * graph.pose(j), *graph.relative_covariance(i, j)}});
      }
    }
    const auto begin = std::chrono::steady_clock::now();
    const auto loops = detector.detect(submaps[j].seen, targets);
    if (auto place = PlaceMap::build(submaps[j].seen, params)) {
      submaps[j].place = std::make_shared<const PlaceMap>(*std::move(place));
    }
    report.detect_s += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    for (const VerifiedLoop& loop : loops) {
      (void)graph.add_edge({loop.id, j, loop.target_T_query.a_T_b, loop.information, EdgeKernel::kSwitchable, 3.0});
    }
    report.loops += loops.size();
    if (!loops.empty()) {
      report.switched_off = graph.optimise(30)->switched_off;
    }
  }
  for (std::size_t j = 0; j < submaps.size(); ++j) {
    const Pose2 correction = graph.pose(j) * inverse(submaps[j].tracked);
    for (std::size_t k = submaps[j].first; k < submaps[j].last; ++k) {
      walk.poses[k] = correction * walk.poses[k];
    }
  }
  return report;
}

}  // namespace seeker::slam
