/// \file
/// Maps and queries from recorded logs, for the tests and benchmarks of place recognition.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <optional>
#include <sstream>
#include <vector>

#include <zlib.h>
#include <Eigen/LU>

#include "common/core/angle.hpp"

#include "server/drivers/replay/replay.hpp"
#include "server/slam/loop_detector.hpp"
#include "server/slam/place_recogniser.hpp"
#include "server/slam/pose_graph.hpp"
#include "server/slam/scan_map_tracker.hpp"

namespace seeker::slam {

/// A log as the tracker sees it: every scan with its pose, and which of them made the map.
struct RecordedWalk {
  std::vector<Pose2> poses;
  std::vector<Pose2> odometry;
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

/// Without `track` every pose is the origin: scans that are not to be placed.
inline std::optional<RecordedWalk> walk_through(const std::filesystem::path& path,
                                                const drivers::ReplayParams& params = {}, bool track = true) {
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
    if (track) {
      (void)tracker.predict(*scan->odom_T_base, stamp);
      (void)tracker.update(laser);
    }
    walk.poses.push_back(tracker.estimate().map_T_base);
    walk.stamps_s.push_back(scan->stamp_s);
    walk.odometry.push_back(*scan->odom_T_base);
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

/// Mean error of the motion between two times over hand-checked relations (Kuemmerle et al. 2009), of those with scans
/// within half a second of both times. `offset_s`: clock of the relations less clock of the log.
struct RelationError {
  double translation_m = 0.0;
  double rotation_deg = 0.0;
  std::size_t count = 0;
};

inline RelationError relation_error(const RecordedWalk& walk, const std::filesystem::path& path, double offset_s) {
  constexpr double kNear_s = 0.5;
  const auto at = [&](double stamp_s) -> const Pose2* {
    const auto after = std::lower_bound(walk.stamps_s.begin(), walk.stamps_s.end(), stamp_s);
    if (after == walk.stamps_s.end()) {
      return nullptr;
    }
    auto k = static_cast<std::size_t>(after - walk.stamps_s.begin());
    if (k > 0 && stamp_s - walk.stamps_s[k - 1] < walk.stamps_s[k] - stamp_s) {
      --k;
    }
    return std::abs(walk.stamps_s[k] - stamp_s) <= kNear_s ? &walk.poses[k] : nullptr;
  };
  RelationError error;
  gzFile file = gzopen(path.c_str(), "rb");
  char line[512];
  while (file != nullptr && gzgets(file, line, sizeof(line)) != nullptr) {
    std::istringstream words(line);
    double from_s = 0.0;
    double to_s = 0.0;
    double z = 0.0;
    double roll = 0.0;
    double pitch = 0.0;
    Pose2 truth;
    if (!(words >> from_s >> to_s >> truth.x_m >> truth.y_m >> z >> roll >> pitch >> truth.theta_rad)) {
      continue;
    }
    const Pose2* from = at(from_s - offset_s);
    const Pose2* to = at(to_s - offset_s);
    if (from != nullptr && to != nullptr) {
      const Pose2 off = inverse(truth) * (inverse(*from) * *to);
      error.translation_m += std::hypot(off.x_m, off.y_m);
      error.rotation_deg += rad_to_deg(std::abs(off.theta_rad));
      ++error.count;
    }
  }
  gzclose(file);
  const auto n = static_cast<double>(std::max<std::size_t>(error.count, 1));
  return {error.translation_m / n, error.rotation_deg / n, error.count};
}

/// What a number of queries came to.
struct PlaceTally {
  std::size_t queries = 0;
  std::size_t unique = 0;
  std::size_t ambiguous = 0;
  std::size_t none = 0;
  std::size_t wrong = 0;  ///< unique, and farther than the tolerance from the truth

  void add(const PlaceAnswer& answer, const std::optional<Pose2>& truth, double tolerance_m, double tolerance_rad) {
    ++queries;
    unique += answer.verdict == PlaceVerdict::kUnique ? 1 : 0;
    ambiguous += answer.verdict == PlaceVerdict::kAmbiguous ? 1 : 0;
    none += answer.verdict == PlaceVerdict::kNone ? 1 : 0;
    if (answer.verdict == PlaceVerdict::kUnique) {
      const Pose2& found = answer.candidates.front().match.map_T_base;
      wrong += !truth || distance_m(found, *truth) > tolerance_m ||
                       std::abs(wrap_angle(found.theta_rad - truth->theta_rad)) > tolerance_rad
                   ? 1
                   : 0;
    }
  }
  [[nodiscard]] double share(std::size_t part) const {
    return static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(queries, 1));
  }
};

}  // namespace seeker::slam
