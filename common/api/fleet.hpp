/// \file
/// Several robots, one map: what a robot that joins another one announces and sends, and what it gets back (spec S4.7).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/api/perception.hpp"
#include "common/core/line_map.hpp"
#include "common/core/occupancy_tile.hpp"
#include "common/core/pose2.hpp"
#include "common/core/searched_floor.hpp"
#include "common/core/topology.hpp"

namespace seeker::api {

/// SHA-256 of a piece: its name wherever it goes.
using PieceHash = std::array<std::uint8_t, 32>;

inline constexpr std::size_t kMaxFleetNodes = 10'000;  ///< of one robot
inline constexpr std::size_t kMaxFleetEdges = 40'000;
inline constexpr std::size_t kMaxFleetRobots = 16;  ///< the main one included
inline constexpr std::size_t kMaxFleetPieceBytes = 8UL << 20U;
inline constexpr std::size_t kMaxFleetChunkBytes = 1UL << 20U;
inline constexpr std::size_t kMaxFleetHypotheses = 16;
// Of one robot's topology: fifteen of them fit into one reply.
inline constexpr std::size_t kMaxFleetPlaces = 2'000;
inline constexpr std::size_t kMaxFleetGoals = 4'000;
inline constexpr std::size_t kMaxFleetSectors = 20'000;
inline constexpr std::size_t kMaxFleetWays = 10'000;
inline constexpr int kMaxFleetLayer = 64;
inline constexpr std::size_t kMaxFleetTiles = 1'024;     ///< of a floor,
inline constexpr int kMaxFleetFloorSide_tiles = 64;      ///< that is at most so wide and so high: 205 m
inline constexpr std::size_t kMaxFleetDetections = 64;   ///< of one robot
inline constexpr int kMaxFleetSearchedSide_cells = 512;  ///< of what one robot tells that it has searched
inline constexpr std::size_t kMaxFleetTargets = 64;      ///< that it was for
inline constexpr double kMaxFleetReach_m = 10'000.0;     ///< a place is not farther from the origin of any map
inline constexpr double kMaxFleetGoal_m = 200.0;         ///< nor a goal from its place
inline constexpr double kMaxFleetCovariance_m2 = 1e6;    ///< an entry of a found target's covariance is not larger

/// A local map by its piece: segments and scans in its own frame, so that it stays the same when the map around moves.
struct FleetNode {
  MapNode node;
  PieceHash hash{};
  std::uint64_t piece_bytes = 0;
  friend bool operator==(const FleetNode&, const FleetNode&) = default;
};

/// Everything a robot has.
struct FleetManifest {
  std::string robot_id;
  std::uint64_t instance = 0;  ///< random per running program: tells a restart from a namesake
  std::uint32_t map_epoch = 0;
  std::uint64_t next_id = 1;  ///< as in LineMap
  std::vector<FleetNode> nodes;
  std::vector<MapEdge> edges;
  std::optional<Pose2> map_T_base;  ///< absent when the robot does not know where it is
  friend bool operator==(const FleetManifest&, const FleetManifest&) = default;
};

struct FleetMissing {
  PieceHash hash{};
  std::uint64_t offset = 0;  ///< bytes before this are there
  friend bool operator==(const FleetMissing&, const FleetMissing&) = default;
};

struct FleetChunk {
  std::string robot_id;
  PieceHash hash{};
  std::uint64_t offset = 0;
  std::vector<std::uint8_t> data;
  friend bool operator==(const FleetChunk&, const FleetChunk&) = default;
};

enum class FleetState : std::uint8_t {
  kWaiting,  ///< pieces are missing, or are being looked at
  kMerged,
  kAmbiguous,  ///< the operator is asked
  kInsufficientOverlap,
  kContradicted,  ///< probably another building
  kSplit,         ///< taken out by the operator
};
[[nodiscard]] std::string_view to_string(FleetState state);

/// One way in which a robot's map may lie in that of the main one.
struct FleetHypothesis {
  Pose2 main_T_map;
  double confidence = 0.0;  ///< 0 to 1
  double shared_wall_m = 0.0;
  double contradiction = 0.0;  ///< share, 0 to 1
  std::uint32_t pairs = 0;     ///< local maps that speak for it
  friend bool operator==(const FleetHypothesis&, const FleetHypothesis&) = default;
};

struct FleetMember {
  std::string robot_id;
  FleetState state = FleetState::kWaiting;
  std::string reason;
  double confidence = 0.0;
  bool by_operator = false;
  bool linked = false;  ///< it has announced itself lately
  std::uint32_t nodes = 0;
  std::uint32_t pieces_missing = 0;
  std::vector<FleetHypothesis> hypotheses;  ///< best first
  std::optional<Pose2> main_T_map;          ///< where it is merged
  std::optional<Pose2> main_T_base;         ///< where it is merged and knows its place
  std::vector<Point2> places;               ///< its local maps, in its own frame `map`
  std::vector<Detection> detections;  ///< where it is merged: what it has found, in the frame `map` of the main one
  friend bool operator==(const FleetMember&, const FleetMember&) = default;
};

struct FleetStatus {
  std::vector<FleetMember> members;  ///< the main one first
  std::uint32_t revision = 0;        ///< rises with every change of who is merged and how
  friend bool operator==(const FleetStatus&, const FleetStatus&) = default;
};

struct FleetAnswer {
  std::vector<FleetMissing> missing;
  FleetStatus fleet;
  friend bool operator==(const FleetAnswer&, const FleetAnswer&) = default;
};

/// Where a robot has been and means to go, in its own frame `map`. Said more often than a manifest.
struct FleetShare {
  std::string robot_id;
  std::uint64_t instance = 0;  ///< as in FleetManifest
  /// Absent when the robot does not know where it is; without places when it has not explored by topology since it was
  /// started.
  std::optional<RobotTopology> topology;
  friend bool operator==(const FleetShare&, const FleetShare&) = default;
};

struct FleetShared {
  FleetState state = FleetState::kWaiting;  ///< of the robot that has told
  std::vector<RobotTopology> others;        ///< where it is merged: all that are, in its own frame `map`
  friend bool operator==(const FleetShared&, const FleetShared&) = default;
};

/// What a robot has seen, in its own frame `map`. Said now and then; empty where it does not know its place.
struct FleetSeen {
  std::string robot_id;
  std::uint64_t instance = 0;             ///< as in FleetManifest
  bool placed = false;                    ///< it knows its place; else what it told before holds
  std::vector<OccupancyTile> tiles;       ///< of the floor, all of them
  std::vector<Detection> detections;      ///< of its missions since it was started
  std::optional<SearchedFloor> searched;  ///< by its last search
  friend bool operator==(const FleetSeen&, const FleetSeen&) = default;
};

/// What another robot has found.
struct FleetFinding {
  std::string robot_id;
  Detection detection;  ///< its id is that robot's own
  friend bool operator==(const FleetFinding&, const FleetFinding&) = default;
};

/// What all other robots that are merged have seen, in the frame `map` of the one that has told; empty where that one
/// is not merged.
struct FleetSightings {
  std::vector<OccupancyTile> floor;
  std::vector<FleetFinding> findings;
  std::vector<SearchedFloor> searched;
  friend bool operator==(const FleetSightings&, const FleetSightings&) = default;
};

/// Those next to `p_map`, as many as the limits above let through.
[[nodiscard]] std::vector<OccupancyTile> within_limits(std::vector<OccupancyTile> tiles, const Point2& p_map);

[[nodiscard]] bool in_reach(const Point2& p_map);
/// Whether a target and the robot that saw it lie within reach, with a covariance that is no nonsense.
[[nodiscard]] bool in_reach(const Detection& detection);

/// Those within reach with the highest ids, by rising id: ids rise over the programs of a robot, stamps begin anew.
[[nodiscard]] std::vector<Detection> within_limits(std::vector<Detection> detections);

/// The same topology within the limits above: places beyond them are left out with what speaks of them, of sectors the
/// newest of each place stay.
[[nodiscard]] RobotTopology within_limits(RobotTopology robot);

enum class FleetVerb : std::uint8_t { kMerge, kSplit };

struct FleetDecision {
  std::string robot_id;
  FleetVerb verb = FleetVerb::kMerge;
  std::uint32_t hypothesis = 0;  ///< of FleetMember::hypotheses
  friend bool operator==(const FleetDecision&, const FleetDecision&) = default;
};

}  // namespace seeker::api
