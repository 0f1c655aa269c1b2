/// \file
/// Hierarchical topology map of a robot as values (spec S4.2): places it has been at, what is free around them, where
/// it still means to go. Robots of a fleet tell each other of theirs.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/core/grid.hpp"
#include "common/core/pose2.hpp"
#include "common/core/searched_floor.hpp"

namespace seeker {

/// Directions in which a corridor of the tree's width is free up to a distance.
struct FreeSector {
  Point2 from_base = Point2::Zero();  ///< where the scanner was, frame of the node's base
  double start_rad = 0.0;             ///< from the node's base's x axis, in (-pi, pi]
  double span_rad = 0.0;              ///< counter-clockwise, 0..2 pi
  double radius_m = 0.0;

  friend bool operator==(const FreeSector&, const FreeSector&) = default;
};

/// A place not visited yet, bound to the node that it will be reached from.
struct TopologyGoal {
  std::uint64_t id = 0;  ///< of its robot; never 0, never used again
  Point2 p_map = Point2::Zero();
  int layer = 1;  ///< of the space tree it came from; the outermost is explored first

  friend bool operator==(const TopologyGoal&, const TopologyGoal&) = default;
};

struct TopologyNode {
  std::uint64_t id = 0;  ///< of its robot; never 0, never used again
  Pose2 map_T_base;
  std::vector<FreeSector> sectors;
  std::vector<TopologyGoal> goals;

  friend bool operator==(const TopologyNode&, const TopologyNode&) = default;
};

/// A way between two nodes of one robot that was driven, or is passable in a straight line.
struct TopologyEdge {
  std::uint64_t a = 0;
  std::uint64_t b = 0;

  friend bool operator==(const TopologyEdge&, const TopologyEdge&) = default;
};

/// What one robot knows; places in the frame `map` of whoever holds the value.
struct Topology {
  std::vector<TopologyNode> nodes;  ///< by rising id
  std::vector<TopologyEdge> edges;
  std::uint64_t current = 0;  ///< the node that the robot is at or comes from; 0: none yet

  friend bool operator==(const Topology&, const Topology&) = default;
};

/// What an exploration by topology goes on from when its program was cut off; frame `map`.
struct TopologyMemory {
  Topology topology;
  std::vector<Point2> closed_map;     ///< goals of its own that were given up
  std::vector<Point2> looked_at_map;  ///< goals of others that were looked at from as near as a way leads

  friend bool operator==(const TopologyMemory&, const TopologyMemory&) = default;
};

/// Another robot of the fleet, its places already in the frame `map` of the robot that reads this.
struct RobotTopology {
  std::string robot_id;
  Pose2 map_T_base;
  std::optional<Twist2> velocity;  ///< of its base; nothing: the place is where it was last heard of
  Topology topology;
  std::optional<Point2> target_map;  ///< the goal it drives to
  bool active = true;                ///< false: it is gone or does not explore; its goals are anybody's

  friend bool operator==(const RobotTopology&, const RobotTopology&) = default;
};

/// What a robot knows of its fleet.
struct FleetView {
  std::string robot_id;  ///< its own
  std::vector<RobotTopology> others;
  /// What they have seen of the floor, cells as in OccupancyTile on multiples of its resolution; null: nothing is told.
  std::shared_ptr<const Grid<std::uint8_t>> floor = nullptr;
  SharedSearch searched = nullptr;  ///< what they have searched

  friend bool operator==(const FleetView&, const FleetView&) = default;
};

}  // namespace seeker
