/// \file
/// One joint map of several robots: all their local maps in one graph, optimised together. The input maps are not
/// changed: leaving a relation out is the undo.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "common/core/line_map.hpp"
#include "server/fleet/pair_check.hpp"

namespace seeker::fleet {

/// The robot's slot and its own id of the local map or segment.
struct Origin {
  std::uint8_t slot = 0;
  std::uint64_t id = 0;

  friend bool operator==(const Origin&, const Origin&) = default;
};

/// Ids in the joint map hold the robot's slot in their upper bits, so that they are stable while maps grow; those of
/// slot 0 are the robot's own.
inline constexpr std::uint32_t kMaxJointNodes = 1U << 24U;
inline constexpr std::uint64_t kMaxJointSegments = std::uint64_t{1} << 48U;
[[nodiscard]] std::uint32_t joint_node_id(std::uint8_t slot, std::uint32_t node);
[[nodiscard]] std::uint64_t joint_segment_id(std::uint8_t slot, std::uint64_t segment);
[[nodiscard]] Origin origin_of_node(std::uint32_t joint_id);
[[nodiscard]] Origin origin_of_segment(std::uint64_t joint_id);
/// Converts a joint map into the map of one robot, which can be joined again: ids that hold another robot's slot are
/// replaced by new ones above its own, in the same order. Other maps are returned unchanged.
[[nodiscard]] LineMap as_one_robots(LineMap map);

/// A robot's own map with its slot in the fleet.
struct RobotMap {
  std::uint8_t slot = 0;
  const LineMap* map = nullptr;  ///< not null; only read while joining
};

/// The relation between the maps of two robots: node pairs of a MergeHypothesis; `a` and `b` of the pairs are these
/// robots.
struct MapRelation {
  std::uint8_t slot_a = 0;
  std::uint8_t slot_b = 0;
  std::vector<NodeRelation> pairs;
};

/// Poses of a robot's local maps in the joint map, since both maps may be distorted differently.
struct JointRobot {
  struct Node {
    Pose2 map_T_node;
    Pose2 joint_T_node;
  };
  std::map<std::uint32_t, Node> nodes;  ///< by the robot's own id; not empty
  Pose2 joint_T_map;                    ///< the rigid motion that fits best where the robot has been
  UncertainPose main_T_first;           ///< pose of its first local map in the frame of the main robot's first one

  /// Transforms a pose in the robot's own frame `map` (of the robot, a goal, a detection) with the nearest local map.
  [[nodiscard]] Pose2 to_joint(const Pose2& map_T_x) const;
  [[nodiscard]] Pose2 from_joint(const Pose2& joint_T_x) const;
};

/// A pair that the others contradict in the joint optimisation.
struct SwitchedOff {
  std::size_t relation = 0;  ///< index of its relation
  std::size_t pair = 0;
};

struct JointMap {
  LineMap map;  ///< in the frame of the first robot's map
  std::map<std::uint8_t, JointRobot> robots;
  std::vector<SwitchedOff> switched_off;
  std::size_t pairs = 0;  ///< number of pairs used
};

struct JointParams {
  double kernel_width = 3.0;  ///< residual, in standard deviations, beyond which a pair loses its weight
  int max_iterations = 50;
};

/// Joins the maps that relations connect to the first; the others are left out. Fails with kInvalidArgument without a
/// map, for two maps in one slot, a first map that is not in the lowest slot, or a relation of an unknown robot or
/// node, with kTooLarge for ids beyond the limits above, and with the errors of slam::PoseGraph. `epoch` of the result
/// is given by the caller: it must rise whenever the map moves.
[[nodiscard]] Result<JointMap> join(const std::vector<RobotMap>& maps, const std::vector<MapRelation>& relations,
                                    std::uint32_t epoch, const JointParams& params = {});

}  // namespace seeker::fleet
