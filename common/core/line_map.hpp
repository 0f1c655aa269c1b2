/// \file
/// A map of line segments as a value: what line SLAM builds, files keep and clients draw.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/pose2.hpp"
#include "common/core/scan.hpp"
#include "common/core/time.hpp"

namespace seeker {

/// A piece of wall (spec S1.2). Its frame sits at the mid-point, x along the wall, y from free space into it: seen from
/// the free side the left end is at x = -length_m / 2.
struct MapSegment {
  std::uint64_t id = 0;    ///< never 0, never reused within a map
  std::uint32_t node = 0;  ///< id of the local map it belongs to
  Pose2 map_T_segment;
  double length_m = 0.0;
  bool left_real = false;  ///< a physical end (corner, door post), not a limit of what was seen
  bool right_real = false;
  Matrix2 covariance = Matrix2::Zero();  ///< of (p_y, p_theta): across the wall in m and its direction in rad
  std::uint32_t hits = 0;                ///< observations
  RobotTime created;
  RobotTime last_seen;

  [[nodiscard]] Point2 left() const { return map_T_segment * Point2(-0.5 * length_m, 0.0); }
  [[nodiscard]] Point2 right() const { return map_T_segment * Point2(0.5 * length_m, 0.0); }
  friend bool operator==(const MapSegment&, const MapSegment&) = default;
};

/// A scan kept with the map, small enough to keep thousands: the evidence behind segments, for occupancy, loop closing
/// and relocalisation.
struct MapKeyframe {
  std::uint32_t node = 0;  ///< id of the local map it belongs to
  RobotTime stamp;
  Pose2 node_T_base;
  Pose2 base_T_laser;
  float angle_min_rad = 0.0F;
  float angle_step_rad = 0.0F;
  float range_max_m = 0.0F;
  std::vector<std::uint16_t> ranges;  ///< in steps of kKeyframeRangeStep_m, or one of the codes below

  friend bool operator==(const MapKeyframe&, const MapKeyframe&) = default;
};
inline constexpr double kKeyframeRangeStep_m = 0.002;
inline constexpr std::uint16_t kKeyframeNoReturn = 0xFFFF;
inline constexpr std::uint16_t kKeyframeUnusable = 0;  ///< the beam had quality 0 and measured no range

[[nodiscard]] MapKeyframe pack_keyframe(const LaserScan& scan, std::uint32_t node, const Pose2& node_T_base);
[[nodiscard]] LaserScan unpack_scan(const MapKeyframe& keyframe);

/// A local map: its pose in the frame `map`.
struct MapNode {
  std::uint32_t id = 0;
  Pose2 map_T_node;
  RobotTime created;

  friend bool operator==(const MapNode&, const MapNode&) = default;
};

/// A measured displacement between two local maps.
struct MapEdge {
  std::uint32_t from = 0;  ///< ids of the two local maps
  std::uint32_t to = 0;
  Pose2 from_T_to;
  Matrix3 covariance = Matrix3::Identity();  ///< of (x, y, theta) in the frame of `from`
  bool loop = false;                         ///< a loop closure; false: the displacement driven from one to the next
  bool enabled = true;  ///< false: a loop closure that was undone or contradicted, kept but not used

  friend bool operator==(const MapEdge&, const MapEdge&) = default;
};

/// A whole map: all that is needed to show it, save it, continue it, and localise in it.
struct LineMap {
  std::uint32_t epoch = 0;     ///< rises when a loop closure or a merge moves the map
  std::uint64_t next_id = 1;   ///< for the next segment
  std::vector<MapNode> nodes;  ///< by rising id; the first is the origin of the frame `map`
  std::vector<MapEdge> edges;
  std::vector<MapSegment> segments;
  std::vector<MapKeyframe> keyframes;

  friend bool operator==(const LineMap&, const LineMap&) = default;
};

/// Refuses maps with ids that are 0, repeated, unknown or not below next_id; with poses or covariances that are
/// not finite or not symmetric positive semi-definite; with local maps that no enabled edge joins to the first one;
/// with lengths below 0; or with scans that have no beams or more than kMaxScanBeams.
[[nodiscard]] Status validate(const LineMap& map);

/// Checks the name of a kept map: [a-z0-9_-]{1,64}, which is also safe as the name of a file.
[[nodiscard]] Status validate_map_name(std::string_view name);

}  // namespace seeker
