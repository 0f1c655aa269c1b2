/// \file
/// Requests and results of a search as values of this folder (the app translates them to api types).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/grid.hpp"
#include "common/core/polygon.hpp"
#include "common/core/pose2.hpp"
#include "common/core/result.hpp"
#include "common/core/time.hpp"
#include "common/core/unreachable.hpp"
#include "server/search/sectors.hpp"

namespace seeker::search {

/// The coverage strategy of a search.
enum class Strategy : std::uint8_t {
  kPaper,     ///< as printed: fuzzy planner, sonars, bearings (spec S3.3)
  kPlan,      ///< planned paths through the occupancy to where evidence is missing
  kSpiral,    ///< baseline: backtracking spiral on 0.8 m cells (Gonzalez et al. 2005)
  kFrontier,  ///< baseline: nearest frontier of the occupancy (Yamauchi 1997)
};
[[nodiscard]] std::string_view to_string(Strategy strategy);

/// What to do when a target is confirmed.
enum class OnFound : std::uint8_t {
  kStop,      ///< end where the robot stands
  kApproach,  ///< drive up to it, refine its position, end
  kContinue,  ///< record it and continue until the area is covered
};

/// An object to search for; its index in SearchRequest::targets is the `target` of a vision::Sighting.
struct SearchTarget {
  std::string name;
  double width_m = 0.4;
  double height_m = 0.4;
  double depth_m = 0.0;  ///< depth of a solid: its position is its centre, half a depth behind the surface that is seen
};

struct SearchRequest {
  std::vector<SearchTarget> targets;
  Strategy strategy = Strategy::kPlan;
  OnFound on_found = OnFound::kApproach;
  nav::ForbiddenAreas areas;  ///< bound and keep-out areas, frame `map`
  bool gaps_only = false;     ///< continue from earlier evidence (SearchMission::keep_evidence)
};

/// Refuses requests with no targets or more than kMaxSearchTargets, sizes outside (0, 10] m, or invalid polygons.
[[nodiscard]] Status validate(const SearchRequest& request);
inline constexpr std::size_t kMaxSearchTargets = 16;
inline constexpr double kMaxTargetSize_m = 10.0;

/// How a search ended.
enum class EndKind : std::uint8_t {
  kTargetFound,
  kNotFoundAreaCovered,
  kUnreachable,  ///< no floor could be searched, or the robot cannot leave the place where it stands
  kUncertain,    ///< the pose is too uncertain to locate a target
};
[[nodiscard]] std::string_view to_string(EndKind kind);

/// Cause and remedy in one sentence each (remedy may be empty).
struct SearchEnd {
  EndKind kind = EndKind::kNotFoundAreaCovered;
  std::string cause;
  std::string remedy;
  std::vector<UnreachablePlace> unreachable = {};  ///< goals that were given up, and how wide what they left out is

  friend bool operator==(const SearchEnd&, const SearchEnd&) = default;
};

/// Returns viewpoints from which the map would grow (ends of walls that were not observed yet), facing what is to be
/// observed. It is called when a goal is chosen. Empty: the search ignores the growth of the map.
using MapViews = std::function<std::vector<Pose2>()>;

/// An event for the mission's log. The text depends on the inputs only.
struct SearchEvent {
  std::string kind;  ///< snake_case: "cell_searched", "escape", "unreachable", "sighting", "confirmed", ...
  std::string text;

  friend bool operator==(const SearchEvent&, const SearchEvent&) = default;
};

/// The lists of spec S3.3.
struct GridLists {
  double cell_size_m = 0.8;
  std::vector<Point2> searched;  ///< in the order of the visits
  std::vector<Point2> unsearched;
  std::vector<Point2> unreachable;
  int passes_n = 0;        ///< n
  int passes_limit_n = 0;  ///< N; 0 where the strategy has none

  friend bool operator==(const GridLists&, const GridLists&) = default;
};

/// Where the range of a detection comes from.
enum class RangeSource : std::uint8_t { kNone, kSonar, kLidar, kTriangulation, kFloor };
[[nodiscard]] std::string_view to_string(RangeSource source);

/// The estimate of one target from all its sightings. The fields are those of api::Detection.
struct Detection {
  std::uint64_t id = 0;  ///< unique within the mission, from 1, in the order of the first sightings
  int target = 0;        ///< index into SearchRequest::targets
  RobotTime stamp;       ///< newest sighting
  double u_px = 0.0;
  double v_px = 0.0;
  double score = 0.0;
  Pose2 map_T_base;               ///< robot pose at the newest sighting
  double bearing_base_rad = 0.0;  ///< alpha', eq (4); of a solid's middle where the lidar shows its outline
  double bearing_map_rad = 0.0;   ///< theta_0 = alpha' + theta_r, eq (5)
  std::optional<Point2> position_map;
  Matrix2 position_covariance = Matrix2::Zero();
  RangeSource range_source = RangeSource::kNone;
  int sightings = 1;
  int misses = 0;  ///< observations that should have shown it and did not
  bool confirmed = false;

  friend bool operator==(const Detection&, const Detection&) = default;
};

/// Reachable floor that the search left below the threshold.
struct Gap {
  Point2 centre_map = Point2::Zero();
  double area_m2 = 0.0;
  std::string reason;  ///< "unreachable", "not seen", "cut off", "keep-out", "outside the bound"

  friend bool operator==(const Gap&, const Gap&) = default;
};

/// The certificate of a search in numbers.
struct CoverageSummary {
  /// Free floor eroded by the robot's radius, allowed, and connected to the robot now or at some time of the search.
  double reachable_area_m2 = 0.0;
  double covered_area_m2 = 0.0;  ///< part of it with a probability of detection at or above the threshold
  double threshold = 0.5;
  double mean_probability = 0.0;
  int gaps = 0;

  friend bool operator==(const CoverageSummary&, const CoverageSummary&) = default;
};

inline constexpr std::uint8_t kNotReachableFloor = 255;

/// Probability that the target would have been seen if it stood in a cell, times 254; kNotReachableFloor elsewhere.
struct EvidenceReport {
  Grid<std::uint8_t> probability;
  std::vector<Gap> gaps;
  CoverageSummary summary;

  friend bool operator==(const EvidenceReport&, const EvidenceReport&) = default;
};

}  // namespace seeker::search
