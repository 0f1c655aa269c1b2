#include "common/core/line_map.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

#include <Eigen/Eigenvalues>

namespace seeker {
namespace {

/// Rounding in a file or in a filter may leave an eigenvalue this little below zero.
constexpr double kRoundingBelowZero = 1e-9;
constexpr std::uint8_t kUsableQuality = 1;

template <int N>
bool is_covariance(const Eigen::Matrix<double, N, N>& m) {
  if (!m.allFinite() || !m.isApprox(m.transpose(), 1e-6)) {
    return false;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> eigen(m, Eigen::EigenvaluesOnly);
  return eigen.eigenvalues()[0] >= -kRoundingBelowZero * std::max(1.0, m.norm());
}

Status check_nodes(const LineMap& map, std::unordered_set<std::uint32_t>& ids) {
  for (const MapNode& node : map.nodes) {
    if (!ids.insert(node.id).second) {
      return fail(Errc::kInvalidArgument, "local map " + std::to_string(node.id) + " is there twice");
    }
    if (!is_finite(node.map_T_node)) {
      return fail(Errc::kInvalidArgument, "local map " + std::to_string(node.id) + " has a pose that is not finite");
    }
  }
  return {};
}

Status check_edges(const LineMap& map, const std::unordered_set<std::uint32_t>& nodes) {
  for (const MapEdge& edge : map.edges) {
    if (!nodes.contains(edge.from) || !nodes.contains(edge.to) || edge.from == edge.to) {
      return fail(Errc::kInvalidArgument, "a relation joins local maps " + std::to_string(edge.from) + " and " +
                                              std::to_string(edge.to) + ", which are not two of this map's");
    }
    if (!is_finite(edge.from_T_to) || !is_covariance<3>(edge.covariance)) {
      return fail(Errc::kInvalidArgument, "the relation of local maps " + std::to_string(edge.from) + " and " +
                                              std::to_string(edge.to) + " has no valid pose or covariance");
    }
  }
  return {};
}

/// Places of local maps that nothing joins would be as good as any others.
Status check_joined(const LineMap& map) {
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> neighbours;
  for (const MapEdge& edge : map.edges) {
    if (edge.enabled) {
      neighbours[edge.from].push_back(edge.to);
      neighbours[edge.to].push_back(edge.from);
    }
  }
  std::unordered_set<std::uint32_t> joined{map.nodes.front().id};
  std::vector<std::uint32_t> open{map.nodes.front().id};
  while (!open.empty()) {
    const std::uint32_t node = open.back();
    open.pop_back();
    for (const std::uint32_t next : neighbours[node]) {
      if (joined.insert(next).second) {
        open.push_back(next);
      }
    }
  }
  for (const MapNode& node : map.nodes) {
    if (!joined.contains(node.id)) {
      return fail(Errc::kInvalidArgument, "no relation joins local map " + std::to_string(node.id) +
                                              " to the first one, so that its place is unknown; save the map again");
    }
  }
  return {};
}

Status check_segments(const LineMap& map, const std::unordered_set<std::uint32_t>& nodes) {
  std::unordered_set<std::uint64_t> ids;
  for (const MapSegment& segment : map.segments) {
    const std::string name = "segment " + std::to_string(segment.id);
    if (segment.id == 0 || segment.id >= map.next_id || !ids.insert(segment.id).second) {
      return fail(Errc::kInvalidArgument, name + " has an id that is 0, used twice or not given out yet");
    }
    if (!nodes.contains(segment.node)) {
      return fail(Errc::kInvalidArgument, name + " belongs to no local map of this map");
    }
    const bool sized = std::isfinite(segment.length_m) && segment.length_m >= 0.0;
    if (!sized || !is_finite(segment.map_T_segment) || !is_covariance<2>(segment.covariance)) {
      return fail(Errc::kInvalidArgument, name + " has no valid pose, length or covariance");
    }
  }
  return {};
}

Status check_keyframes(const LineMap& map, const std::unordered_set<std::uint32_t>& nodes) {
  for (const MapKeyframe& keyframe : map.keyframes) {
    const bool beams = !keyframe.ranges.empty() && keyframe.ranges.size() <= kMaxScanBeams;
    const bool geometry = std::isfinite(keyframe.angle_min_rad) && std::isfinite(keyframe.angle_step_rad) &&
                          keyframe.angle_step_rad != 0.0F && std::isfinite(keyframe.range_max_m);
    if (!nodes.contains(keyframe.node) || !beams || !geometry || !is_finite(keyframe.node_T_base) ||
        !is_finite(keyframe.base_T_laser)) {
      return fail(Errc::kInvalidArgument,
                  "a kept scan of local map " + std::to_string(keyframe.node) + " is not a scan of this map");
    }
  }
  return {};
}

std::uint16_t range_code(float range_m) {
  const double steps = std::round(static_cast<double>(range_m) / kKeyframeRangeStep_m);
  return steps < kKeyframeNoReturn ? static_cast<std::uint16_t>(std::max(1.0, steps)) : kKeyframeNoReturn;
}

}  // namespace

MapKeyframe pack_keyframe(const LaserScan& scan, std::uint32_t node, const Pose2& node_T_base) {
  MapKeyframe keyframe;
  keyframe.node = node;
  keyframe.stamp = scan.stamp;
  keyframe.node_T_base = node_T_base;
  keyframe.base_T_laser = scan.base_T_laser;
  keyframe.angle_min_rad = static_cast<float>(scan.angle_min_rad);
  keyframe.angle_step_rad = static_cast<float>(scan.angle_step_rad);
  keyframe.range_max_m = static_cast<float>(scan.range_max_m);
  keyframe.ranges.reserve(scan.ranges_m.size());
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const bool unusable = !scan.quality.empty() && scan.quality[i] == 0;
    keyframe.ranges.push_back(unusable ? kKeyframeUnusable : range_code(scan.ranges_m[i]));
  }
  return keyframe;
}

LaserScan unpack_scan(const MapKeyframe& keyframe) {
  LaserScan scan;
  scan.stamp = keyframe.stamp;
  scan.angle_min_rad = static_cast<double>(keyframe.angle_min_rad);
  scan.angle_step_rad = static_cast<double>(keyframe.angle_step_rad);
  scan.range_max_m = static_cast<double>(keyframe.range_max_m);
  scan.base_T_laser = keyframe.base_T_laser;
  scan.ranges_m.reserve(keyframe.ranges.size());
  for (const std::uint16_t code : keyframe.ranges) {
    const bool none = code == kKeyframeNoReturn || code == kKeyframeUnusable;
    scan.ranges_m.push_back(none ? kNoReturn : static_cast<float>(code * kKeyframeRangeStep_m));
  }
  if (std::find(keyframe.ranges.begin(), keyframe.ranges.end(), kKeyframeUnusable) != keyframe.ranges.end()) {
    scan.quality.reserve(keyframe.ranges.size());
    for (const std::uint16_t code : keyframe.ranges) {
      scan.quality.push_back(code == kKeyframeUnusable ? 0 : kUsableQuality);
    }
  }
  return scan;
}

Status validate(const LineMap& map) {
  std::unordered_set<std::uint32_t> nodes;
  if (Status ok = check_nodes(map, nodes); !ok) {
    return ok;
  }
  if (Status ok = check_edges(map, nodes); !ok) {
    return ok;
  }
  if (Status ok = map.nodes.empty() ? Status() : check_joined(map); !ok) {
    return ok;
  }
  if (Status ok = check_segments(map, nodes); !ok) {
    return ok;
  }
  return check_keyframes(map, nodes);
}

Status validate_map_name(std::string_view name) {
  constexpr std::size_t kMaxName = 64;
  const bool allowed = std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  });
  if (name.empty() || name.size() > kMaxName || !allowed) {
    return fail(Errc::kInvalidArgument,
                "a map's name has 1 to 64 of the characters a-z, 0-9, - and _, as in office-2nd_floor");
  }
  return {};
}

}  // namespace seeker
