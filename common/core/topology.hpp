/// \file
/// Hierarchical topology map of a robot as values (spec S4.2): the places it has been at, the free space around them,
/// and the goals it has still to visit. Robots of a fleet exchange their topologies.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/core/grid.hpp"
#include "common/core/mapped_side.hpp"
#include "common/core/pose2.hpp"
#include "common/core/searched_floor.hpp"

namespace seeker {

/// Directions in which a corridor of the width of the admissible space tree is free up to a distance.
struct FreeSector {
  Point2 from_base = Point2::Zero();  ///< position of the scanner in the frame of the node's base
  double start_rad = 0.0;             ///< first direction, from the x axis of the node's base, in (-pi, pi]
  double span_rad = 0.0;              ///< angle from the first to the last direction, counter-clockwise, 0..2 pi
  double radius_m = 0.0;

  friend bool operator==(const FreeSector&, const FreeSector&) = default;
};

/// A place that has not been visited yet; it belongs to the node from which it will be reached.
struct TopologyGoal {
  std::uint64_t id = 0;  ///< of its robot; never 0, never used again
  Point2 p_map = Point2::Zero();
  int layer = 1;  ///< of the space tree that the goal came from; the outermost layer is explored first

  friend bool operator==(const TopologyGoal&, const TopologyGoal&) = default;
};

struct TopologyNode {
  std::uint64_t id = 0;  ///< of its robot; never 0, never used again
  Pose2 map_T_base;
  std::vector<FreeSector> sectors;
  std::vector<TopologyGoal> goals;

  friend bool operator==(const TopologyNode&, const TopologyNode&) = default;
};

/// A path between two nodes of one robot that was driven, or is passable in a straight line. Names their ids.
struct TopologyEdge {
  std::uint64_t a = 0;
  std::uint64_t b = 0;

  friend bool operator==(const TopologyEdge&, const TopologyEdge&) = default;
};

/// The topology of one robot; places are in the frame `map` of the robot that holds the value.
struct Topology {
  std::vector<TopologyNode> nodes;  ///< by rising id
  std::vector<TopologyEdge> edges;
  std::uint64_t current = 0;  ///< id of the node that the robot is at or comes from; 0: none yet

  friend bool operator==(const Topology&, const Topology&) = default;
};

/// The state from which an exploration by topology is resumed after its program was cut off; frame `map`.
struct TopologyMemory {
  Topology topology;
  std::vector<Point2> closed_map;     ///< own goals that were given up
  std::vector<Point2> looked_at_map;  ///< goals of others, observed from as near as a path leads

  friend bool operator==(const TopologyMemory&, const TopologyMemory&) = default;
};

/// Another robot of the fleet, its places already in the frame `map` of the robot that reads this.
struct RobotTopology {
  std::string robot_id;
  Pose2 map_T_base;
  std::optional<Twist2> velocity;  ///< of its base; empty: its pose is the last one received
  Topology topology;
  std::optional<Point2> target_map;  ///< position of the goal that it drives to
  bool active = true;                ///< false: it is gone or does not explore; others may take its goals

  friend bool operator==(const RobotTopology&, const RobotTopology&) = default;
};

/// What a robot has received from the other robots of its fleet.
struct FleetView {
  std::string robot_id;  ///< id of the robot that holds this value
  std::vector<RobotTopology> others;
  /// Occupancy that the others have reported, cells as in OccupancyTile on multiples of its resolution; null: none.
  std::shared_ptr<const Grid<std::uint8_t>> floor = nullptr;
  SharedSearch searched = nullptr;  ///< floor that the others have searched
  SharedSides sides = nullptr;      ///< sides of walls that the others have mapped, frame `map`; null: none

  friend bool operator==(const FleetView&, const FleetView&) = default;
};

}  // namespace seeker
