/// \file
/// Missions as values: what can be asked for, how it goes, how it ended.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "common/api/link_policy.hpp"
#include "common/api/perception.hpp"
#include "common/api/transfer.hpp"
#include "common/core/explore_decision.hpp"
#include "common/core/image.hpp"
#include "common/core/polygon.hpp"
#include "common/core/pose2.hpp"
#include "common/core/solid.hpp"
#include "common/core/time.hpp"
#include "common/core/unreachable.hpp"

namespace seeker::api {

/// Chosen by the client so that repeating a start is harmless: [a-z0-9-]{1,64}.
using MissionId = std::string;

/// How a target is recognised in an image.
enum class RecogniserKind : std::uint8_t {
  kTemplate,  ///< dynamic template matching (spec S3.4)
  kFeatures,  ///< SIFT matches verified by a homography
  kSolid,     ///< a solid by its shape, in turbid water (spec S6): no picture is needed
};

/// A target to search for: its picture, or which solid it is, and its size.
struct TargetSpec {
  std::string name;      ///< [a-z0-9-]{1,32}, unique in a mission
  Image picture;         ///< upright view of the target, cropped to its border; empty for a solid
  double width_m = 0.4;  ///< of the target's picture or of the solid, used for range limits and evidence
  double height_m = 0.4;
  double depth_m = 0.0;  ///< of a solid that shows the picture on its sides; 0: flat. Its position is its centre
  RecogniserKind recogniser = RecogniserKind::kTemplate;
  SolidKind solid = SolidKind::kSphere;  ///< for the recogniser of solids; the others ignore it
  /// In place of the picture: the hash of one that was uploaded before.
  std::optional<FileHash> picture_hash = std::nullopt;

  friend bool operator==(const TargetSpec&, const TargetSpec&) = default;
};

/// A solid of usual size, named by its shape.
[[nodiscard]] TargetSpec solid_target(SolidKind solid);
inline constexpr double kSolidSize_m = 0.2;

enum class SearchMode : std::uint8_t {
  kPaper,  ///< the algorithm as printed: sonar and bearing only (spec S3.3)
  kPlan,   ///< cells are reached by paths planned through the occupancy
};

enum class OnFound : std::uint8_t {
  kStop,      ///< end the mission where the robot stands
  kApproach,  ///< drive up to the target, refine its position, end
  kContinue,  ///< note it and go on until the area is covered
};

struct SearchMission {
  std::vector<TargetSpec> targets;
  SearchMode mode = SearchMode::kPlan;
  OnFound on_found = OnFound::kApproach;
  std::optional<Polygon> bound;   ///< search inside only
  std::vector<Polygon> keep_out;  ///< never enter
  bool gaps_only = false;         ///< keep the evidence of the last search and cover what it left
  bool explore = false;           ///< map the building too: the search goes on until no wall is left open

  friend bool operator==(const SearchMission&, const SearchMission&) = default;
};

/// How an exploration chooses its goals: the first two build the map actively, the next three are what they are
/// compared with; then one whose goals the robots of a fleet share, and tours. docs/client.md says how long each takes
/// and how certain the pose is by then.
enum class ExploreStrategy : std::uint8_t {
  kActive,       ///< the published rule: one step of the objective of spec S1.11, out of traps along walls
  kHorizon,      ///< the same objective over several drives to reachable viewpoints
  kRoam,         ///< straight on until an obstacle is near, then rotate
  kFrontier,     ///< nearest frontier
  kGain,         ///< most unknown floor in sight for the path length
  kTopological,  ///< goals of space trees, kept at the nodes of a topology map (spec S4.4)
  kTour,         ///< a tour over all still to be seen: what is used unless another is named
};
/// All of them, in order.
inline constexpr std::array kExploreStrategies{
    ExploreStrategy::kActive, ExploreStrategy::kHorizon,     ExploreStrategy::kRoam, ExploreStrategy::kFrontier,
    ExploreStrategy::kGain,   ExploreStrategy::kTopological, ExploreStrategy::kTour};
/// The shortest and the fastest of all in offices and hospitals, with as much of the walls as kFrontier maps
/// (docs/results.md).
inline constexpr ExploreStrategy kDefaultExploreStrategy = ExploreStrategy::kTour;

/// Maps a building by itself.
struct ExploreMission {
  ExploreStrategy strategy = kDefaultExploreStrategy;
  std::optional<Polygon> bound;   ///< explore inside only
  std::vector<Polygon> keep_out;  ///< never enter
  bool return_to_start = false;

  friend bool operator==(const ExploreMission&, const ExploreMission&) = default;
};

struct GotoMission {
  std::vector<Point2> waypoints;  ///< visited in order, in the frame `map`
  std::optional<double> final_heading_rad;
  std::vector<Polygon> keep_out;

  friend bool operator==(const GotoMission&, const GotoMission&) = default;
};

/// Back to where the robot was started, over floor that it has seen.
struct ReturnMission {
  std::optional<Polygon> bound;    ///< stay inside
  std::vector<Polygon> keep_out;   ///< never enter
  std::vector<Point2> along = {};  ///< in the frame `map`: pass here, in this order; clients cannot ask for it

  friend bool operator==(const ReturnMission&, const ReturnMission&) = default;
};

/// Builds a database of landmarks: stereo pictures in several directions at several places (spec S2.4).
struct SurveyMission {
  std::string landmarks;       ///< name of the database, as in validate_map_name()
  std::vector<Point2> places;  ///< in the frame `map`; none: where the robot stands, and four places around it
  int headings = 12;           ///< pictures at each place, evenly around
  bool replace = false;        ///< an existing database of that name
  std::vector<Polygon> keep_out;

  friend bool operator==(const SurveyMission&, const SurveyMission&) = default;
};

/// Finds the robot's place by the landmarks of a database, wherever it was switched on.
struct LocaliseMission {
  std::string landmarks;
  int headings = 12;  ///< directions to look into before it gives up

  friend bool operator==(const LocaliseMission&, const LocaliseMission&) = default;
};

/// Says which targets are in front of the camera. The robot never leaves its place.
struct RecogniseMission {
  std::vector<TargetSpec> targets;
  int headings = 1;  ///< directions to look into, evenly around; 1: as it stands

  friend bool operator==(const RecogniseMission&, const RecogniseMission&) = default;
};

using MissionTask = std::variant<SearchMission, GotoMission, ReturnMission, ExploreMission, SurveyMission,
                                 LocaliseMission, RecogniseMission>;

[[nodiscard]] std::string_view task_name(const MissionTask& task);
/// The targets of a task; nullptr where its kind has none.
[[nodiscard]] std::vector<TargetSpec>* targets_of(MissionTask& task);

struct MissionRequest {
  MissionId id;
  MissionTask task;
  LinkPolicy link_policy = LinkPolicy::kStop;
  std::optional<Duration> time_limit;  ///< robot time in which it runs: neither paused nor held by a fault
  LinkSteps link_steps = {};           ///< what the robot does when its client is silent; empty: as link_policy says

  friend bool operator==(const MissionRequest&, const MissionRequest&) = default;
};

/// The answer to a mission that was started.
struct MissionAccepted {
  MissionId id;
  LinkSteps link_steps;  ///< the link policy that applies

  friend bool operator==(const MissionAccepted&, const MissionAccepted&) = default;
};

/// Checks everything that can be checked without a robot; the robot calls it too.
[[nodiscard]] Status validate(const MissionRequest& request);
inline constexpr std::size_t kMaxTargets = 16;
inline constexpr std::size_t kMaxKeepOuts = 64;
inline constexpr std::size_t kMaxWaypoints = 1024;
inline constexpr std::size_t kMaxSurveyPlaces = 64;
inline constexpr int kMaxHeadings = 72;
/// A template with less spread of grey than this carries nothing to match.
inline constexpr double kMinTargetGreySigma = 4.0;
inline constexpr int kMinTargetSide_px = 8;
inline constexpr int kMaxTargetSide_px = 1024;

/// How a mission ended.
enum class Outcome : std::uint8_t {
  kComplete,
  kTargetFound,
  kNotFoundAreaCovered,
  kUnreachable,
  kBoundReached,
  kTimeLimit,
  kUncertain,
  kLost,
  kBattery,
  kLinkLost,
  kOperator,
  kFault,
};

[[nodiscard]] std::string_view to_string(Outcome outcome);
[[nodiscard]] std::string_view to_string(RecogniserKind kind);
[[nodiscard]] std::string_view to_string(SearchMode mode);
[[nodiscard]] std::string_view to_string(OnFound on_found);
[[nodiscard]] std::string_view to_string(ExploreStrategy strategy);

enum class MissionState : std::uint8_t { kRunning, kPaused, kEnded };
[[nodiscard]] std::string_view to_string(MissionState state);

/// The end of a mission, with cause and remedy in one sentence each.
struct MissionEnd {
  Outcome outcome = Outcome::kFault;
  std::string cause;
  std::string remedy;  ///< empty when there is nothing to remedy
  /// Places that were asked for or found and could not be reached, each with its cause.
  std::vector<UnreachablePlace> unreachable;

  friend bool operator==(const MissionEnd&, const MissionEnd&) = default;
};

/// One report of a running or ended mission.
struct MissionStatus {
  MissionId id;
  std::string kind;  ///< task_name()
  MissionState state = MissionState::kRunning;
  std::string phase;      ///< "cover", "approach", "drive", ...
  std::string activity;   ///< what the robot is doing and why, one sentence
  double progress = 0.0;  ///< 0..1
  RobotTime started;
  RobotTime updated;
  double path_length_m = 0.0;
  int cells_searched = 0;
  int cells_unsearched = 0;
  std::optional<CoverageSummary> coverage;
  std::vector<Point2> planned_path;  ///< in the frame `map`
  /// The newest of an exploration. Reports of a running mission carry each decision once, RobotStatus none.
  std::optional<ExploreDecision> decision;
  LinkPolicy link_policy = LinkPolicy::kStop;
  LinkSteps link_steps = {};      ///< the link policy that applies
  std::optional<MissionEnd> end;  ///< present exactly when state is kEnded

  friend bool operator==(const MissionStatus&, const MissionStatus&) = default;
};

enum class MissionCommand : std::uint8_t { kPause, kResume, kStop };

}  // namespace seeker::api
