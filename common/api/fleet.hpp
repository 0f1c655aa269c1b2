/// \file
/// Maps of several robots: what a robot that joins the main robot announces and sends, and what it receives (spec
/// S4.7).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/api/perception.hpp"
#include "common/core/line_map.hpp"
#include "common/core/mapped_side.hpp"
#include "common/core/occupancy_tile.hpp"
#include "common/core/pose2.hpp"
#include "common/core/searched_floor.hpp"
#include "common/core/topology.hpp"

namespace seeker::api {

/// SHA-256 of a piece, by which all robots name it.
using PieceHash = std::array<std::uint8_t, 32>;

inline constexpr std::size_t kMaxFleetNodes = 10'000;  ///< of one robot
inline constexpr std::size_t kMaxFleetEdges = 40'000;
inline constexpr std::size_t kMaxFleetRobots = 16;  ///< the main one included
inline constexpr std::size_t kMaxFleetPieceBytes = 8UL << 20U;
inline constexpr std::size_t kMaxFleetPictures = 2'000;             ///< of one robot
inline constexpr std::size_t kMaxFleetPictureFeatures = 1'000;      ///< of one picture
inline constexpr std::size_t kMaxFleetPictureBytes = 256UL << 10U;  ///< of the piece of one picture
inline constexpr std::size_t kMaxFleetChunkBytes = 1UL << 20U;
inline constexpr std::size_t kMaxFleetHypotheses = 16;
// Of one robot's topology: fifteen of them fit into one reply.
inline constexpr std::size_t kMaxFleetPlaces = 2'000;
inline constexpr std::size_t kMaxFleetGoals = 4'000;
inline constexpr std::size_t kMaxFleetSectors = 20'000;
inline constexpr std::size_t kMaxFleetTopologyEdges = 10'000;
inline constexpr int kMaxFleetLayer = 64;
inline constexpr std::size_t kMaxFleetTiles = 1'024;     ///< of the floor of one robot
inline constexpr int kMaxFleetFloorSide_tiles = 64;      ///< largest width and height of a floor: 205 m
inline constexpr std::size_t kMaxFleetSides = 4'000;     ///< of walls that one robot has mapped
inline constexpr std::size_t kMaxFleetDetections = 64;   ///< of one robot
inline constexpr int kMaxFleetSearchedSide_cells = 512;  ///< largest side of the searched floor of one robot
inline constexpr std::size_t kMaxFleetTargets = 64;      ///< of the searched floor of one robot
inline constexpr double kMaxFleetReach_m = 10'000.0;     ///< largest distance of a place from the origin of a map
inline constexpr double kMaxFleetGoal_m = 200.0;         ///< largest distance of a goal from its node
inline constexpr double kMaxFleetCovariance_m2 = 1e6;    ///< largest entry of the covariance of a detection

/// A local map and the piece that holds it: segments and scans in the frame of the local map, so that the piece stays
/// the same when the local map moves.
struct FleetNode {
  MapNode node;
  PieceHash hash{};
  std::uint64_t piece_bytes = 0;
  friend bool operator==(const FleetNode&, const FleetNode&) = default;
};

/// The piece that holds the features of a picture, which was taken at a node of the robot's topology.
struct FleetPicture {
  PieceHash hash{};
  std::uint64_t piece_bytes = 0;
  friend bool operator==(const FleetPicture&, const FleetPicture&) = default;
};

/// The list of all local maps of a robot, with the edges between them, and of its pictures.
struct FleetManifest {
  std::string robot_id;
  std::uint64_t instance =
      0;  ///< random number of the running program: distinguishes a restart from another robot of this id
  std::uint32_t map_epoch = 0;
  std::uint64_t next_id = 1;  ///< as in LineMap
  std::vector<FleetNode> nodes;
  std::vector<MapEdge> edges;
  std::vector<FleetPicture> pictures;
  std::optional<Pose2> map_T_base;  ///< absent when the robot does not know where it is
  friend bool operator==(const FleetManifest&, const FleetManifest&) = default;
};

struct FleetMissing {
  PieceHash hash{};
  std::uint64_t offset = 0;  ///< number of bytes that the main robot has already received
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
  kWaiting,  ///< pieces are missing, or are being compared
  kMerged,
  kAmbiguous,  ///< several hypotheses fit; the operator decides
  kInsufficientOverlap,
  kContradicted,  ///< probably another building
  kSplit,         ///< taken out by the operator
};
[[nodiscard]] std::string_view to_string(FleetState state);

/// One hypothesis of the pose of a robot's map in the map of the main robot.
struct FleetHypothesis {
  Pose2 main_T_map;
  double confidence = 0.0;  ///< 0 to 1
  double shared_wall_m = 0.0;
  double contradiction = 0.0;  ///< share of the walls that the other map denies, 0 to 1
  std::uint32_t pairs = 0;     ///< number of pairs of local maps that support it
  std::uint32_t pictures = 0;  ///< number of places whose pictures show the same as the other robot's
  friend bool operator==(const FleetHypothesis&, const FleetHypothesis&) = default;
};

/// The merge of two maps by which a robot belongs to the joint map.
struct FleetMergedWith {
  std::string through;         ///< id of the robot with whose map its own is merged; empty: with the main one's
  std::uint32_t pictures = 0;  ///< number of places whose pictures show the same in both maps
  friend bool operator==(const FleetMergedWith&, const FleetMergedWith&) = default;
};

struct FleetMember {
  std::string robot_id;
  FleetState state = FleetState::kWaiting;
  std::string reason;
  double confidence = 0.0;
  bool by_operator = false;
  bool linked = false;  ///< true: it has announced itself lately
  std::uint32_t nodes = 0;
  std::uint32_t pieces_missing = 0;
  std::uint32_t pictures = 0;                  ///< of nodes of its topology, announced
  std::vector<FleetHypothesis> hypotheses;     ///< for its map in the main one, best first
  std::optional<FleetMergedWith> merged_with;  ///< empty where it is not merged, and for the main robot
  std::optional<Pose2> main_T_map;             ///< pose of its map; empty where it is not merged
  std::optional<Pose2> main_T_base;            ///< pose of the robot; empty where it is not merged or not localised
  std::vector<Point2> places;                  ///< positions of its local maps, in its own frame `map`
  std::vector<Detection> detections;  ///< if it is merged: its detections, in the frame `map` of the main robot
  friend bool operator==(const FleetMember&, const FleetMember&) = default;
};

struct FleetStatus {
  std::vector<FleetMember> members;  ///< the main robot first
  std::uint32_t revision = 0;        ///< rises with every change of who is merged and how
  friend bool operator==(const FleetStatus&, const FleetStatus&) = default;
};

struct FleetAnswer {
  std::vector<FleetMissing> missing;
  FleetStatus fleet;
  friend bool operator==(const FleetAnswer&, const FleetAnswer&) = default;
};

/// The topology of a robot, in its own frame `map`: where it has been and where it will go. Sent more often than a
/// manifest.
struct FleetShare {
  std::string robot_id;
  std::uint64_t instance = 0;  ///< as in FleetManifest
  /// Absent when the robot is not localised; without nodes when it has not explored by topology since it was started.
  std::optional<RobotTopology> topology;
  friend bool operator==(const FleetShare&, const FleetShare&) = default;
};

struct FleetShared {
  FleetState state = FleetState::kWaiting;  ///< of the robot that has sent the share
  std::vector<RobotTopology> others;        ///< if it is merged: all other merged robots, in its own frame `map`
  friend bool operator==(const FleetShared&, const FleetShared&) = default;
};

/// Occupancy, mapped walls, detections and searched floor of a robot, in its own frame `map`. Empty where the robot is
/// not localised.
struct FleetSeen {
  std::string robot_id;
  std::uint64_t instance = 0;             ///< as in FleetManifest
  bool placed = false;                    ///< true: the robot is localised; false: its last report stays valid
  std::vector<OccupancyTile> tiles;       ///< all tiles of its occupancy map
  std::vector<Detection> detections;      ///< of all its missions since it was started
  std::optional<SearchedFloor> searched;  ///< of its last search
  std::vector<MappedSide> sides = {};     ///< all sides of walls in its map
  friend bool operator==(const FleetSeen&, const FleetSeen&) = default;
};

/// A detection by another robot.
struct FleetFinding {
  std::string robot_id;
  Detection detection;  ///< with the id that the other robot has given it
  friend bool operator==(const FleetFinding&, const FleetFinding&) = default;
};

/// What all other merged robots have reported, in the frame `map` of the robot that receives it; empty where that robot
/// is not merged.
struct FleetSightings {
  std::vector<OccupancyTile> floor;
  std::vector<FleetFinding> findings;
  std::vector<SearchedFloor> searched;
  std::vector<MappedSide> sides = {};
  friend bool operator==(const FleetSightings&, const FleetSightings&) = default;
};

/// What the robots of a fleet have reported, in the frame `map` of the main robot, to be looked at.
struct FleetScene {
  std::vector<OccupancyTile> floor;
  std::vector<RobotTopology> robots;  ///< those that are localised, the main robot first
  std::vector<FleetFinding> findings;
  friend bool operator==(const FleetScene&, const FleetScene&) = default;
};

/// The tiles that are nearest to `p_map`, as many as the limits above allow.
[[nodiscard]] std::vector<OccupancyTile> within_limits(std::vector<OccupancyTile> tiles, const Point2& p_map);

/// The sides within reach that are nearest to `p_map`, as many as one robot may report.
[[nodiscard]] std::vector<MappedSide> within_limits(std::vector<MappedSide> sides, const Point2& p_map);

[[nodiscard]] bool in_reach(const Point2& p_map);
/// Whether a target and the robot that detected it lie within kMaxFleetReach_m, with a covariance within
/// kMaxFleetCovariance_m2.
[[nodiscard]] bool in_reach(const Detection& detection);

/// The detections within reach that have the highest ids, by rising id. Ids rise over all runs of a robot program,
/// while stamps begin at zero in each run.
[[nodiscard]] std::vector<Detection> within_limits(std::vector<Detection> detections);

/// The topology cut to the limits above: nodes and goals beyond them are left out with all that refers to them, and of
/// the sectors of each node the newest are kept.
[[nodiscard]] RobotTopology within_limits(RobotTopology robot);

enum class FleetVerb : std::uint8_t { kMerge, kSplit };

struct FleetDecision {
  std::string robot_id;
  FleetVerb verb = FleetVerb::kMerge;
  std::uint32_t hypothesis = 0;  ///< index into FleetMember::hypotheses
  friend bool operator==(const FleetDecision&, const FleetDecision&) = default;
};

}  // namespace seeker::api
