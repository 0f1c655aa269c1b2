/// \file
/// Mapped walls and filters that know them, for the tests of this folder.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "common/core/angle.hpp"
#include "common/core/line_map.hpp"
#include "server/lines/observation.hpp"
#include "server/slam/sp_map.hpp"

namespace seeker::explore::test {

/// The wall from its left end (seen from the free side) to its right end.
inline MapSegment wall(const Point2& left, const Point2& right, std::array<bool, 2> real = {false, false}) {
  static std::uint64_t next_id = 1;
  const Point2 d = right - left;
  MapSegment segment;
  segment.id = next_id++;
  segment.map_T_segment = {0.5 * (left.x() + right.x()), 0.5 * (left.y() + right.y()), std::atan2(d.y(), d.x())};
  segment.length_m = d.norm();
  segment.left_real = real[0];
  segment.right_real = real[1];
  segment.covariance << 1e-4, 0.0, 0.0, 1e-4;
  segment.hits = 10;
  return segment;
}

inline std::vector<MapSegment> moved(std::vector<MapSegment> segments, const Pose2& by) {
  for (MapSegment& segment : segments) {
    segment.map_T_segment = by * segment.map_T_segment;
  }
  return segments;
}

/// A filter in its own frame that has seen these walls from `map_T_base`, all of them at once.
inline slam::SpMap filter_of(const std::vector<MapSegment>& segments, const Pose2& map_T_base) {
  slam::SpMapParams params;
  params.features.real_scans = 1;
  slam::SpMap map(map_T_base, 1e-4 * Matrix3::Identity(), params);
  std::vector<lines::SegmentObservation> seen;
  slam::Association all_new;
  for (const MapSegment& segment : segments) {
    lines::SegmentObservation one;
    one.base_T_segment = inverse(map_T_base) * segment.map_T_segment;
    one.length_m = segment.length_m;
    one.real = {segment.left_real, segment.right_real};
    one.covariance << 4e-4, 0.0, 0.0, 4e-4;
    one.end_sigma_m = {0.03, 0.03};
    one.points = 40;
    seen.push_back(one);
    all_new.matches.emplace_back();
  }
  map.update(seen, all_new);
  map.predict({}, 1e-3 * Matrix3::Identity());  // since then the robot has become less sure
  return map;
}

inline constexpr double kNorth = kPi / 2.0;

}  // namespace seeker::explore::test
