/// \file
/// Results of a search: grid lists, evidence, detections.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/grid.hpp"
#include "common/core/pose2.hpp"
#include "common/core/time.hpp"

namespace seeker::api {

/// Where the range of a detection comes from.
enum class RangeSource : std::uint8_t {
  kNone,
  kSonar,
  kLidar,
  kTriangulation,
  kFloor,  ///< from the row at which the picture shows it on the floor, by the height of the camera
};
[[nodiscard]] std::string_view to_string(RangeSource source);

/// A target that was seen: one sighting, or several that were fused.
struct Detection {
  std::uint64_t id = 0;  ///< never reused
  std::string target;
  RobotTime stamp;    ///< of the newest sighting
  double u_px = 0.0;  ///< column and row in the image of the newest sighting
  double v_px = 0.0;
  double score = 0.0;              ///< score of the recogniser, 0..1
  Pose2 map_T_base;                ///< pose of the robot at the newest sighting
  double bearing_base_rad = 0.0;   ///< alpha' of spec S3.5, eq (4)
  double bearing_map_rad = 0.0;    ///< theta_0 of eq (5)
  std::optional<Point2> position;  ///< of the target's centre in the frame `map`
  Matrix2 position_covariance = Matrix2::Zero();
  RangeSource range_source = RangeSource::kNone;
  int sightings = 1;
  std::uint32_t map_epoch = 0;
  std::string mission;     ///< id of the mission that has found it
  bool withdrawn = false;  ///< in updates only: it has proved to be no target, and no list contains it any more

  friend bool operator==(const Detection&, const Detection&) = default;
};

/// The detection after its map has moved: `new_T_old` is the pose of the old frame `map` in the new one, or of the
/// frame of one robot in that of another. The epoch stays.
[[nodiscard]] Detection moved(Detection detection, const Pose2& new_T_old);

/// The lists of searched and unsearched cells of spec S3.3, and the cells that could not be reached. Cell centres,
/// frame `map`.
struct GridLists {
  double cell_size_m = 0.8;
  std::vector<Point2> searched;  ///< in the order of the visits
  std::vector<Point2> unsearched;
  std::vector<Point2> unreachable;
  int passes_n = 0;        ///< n: consecutive passes over searched cells
  int passes_limit_n = 0;  ///< N of eq (1)

  friend bool operator==(const GridLists&, const GridLists&) = default;
};

/// The certificate of a search: how much of the reachable floor was searched, and how well.
struct CoverageSummary {
  double reachable_area_m2 =
      0.0;  ///< free floor eroded by the robot's radius that is, or once was, connected to the robot
  double covered_area_m2 = 0.0;  ///< part of it with a probability of detection at or above the threshold
  double threshold = 0.5;
  double mean_probability = 0.0;  ///< of detection, over the reachable floor
  int gaps = 0;                   ///< number of connected areas below the threshold

  friend bool operator==(const CoverageSummary&, const CoverageSummary&) = default;
};

/// A connected area of reachable floor that the search left below the threshold.
struct Gap {
  Point2 centre = Point2::Zero();
  double area_m2 = 0.0;
  std::string reason;  ///< "unreachable", "not seen", "cut off", "keep-out", "outside the bound"

  friend bool operator==(const Gap&, const Gap&) = default;
};

inline constexpr std::uint8_t kNotReachableFloor = 255;

/// Probability that the target would have been detected if it stood in a cell, times 254; kNotReachableFloor elsewhere.
struct EvidenceMap {
  Grid<std::uint8_t> probability;
  std::vector<Gap> gaps;
  CoverageSummary summary;
  std::uint32_t map_epoch = 0;

  friend bool operator==(const EvidenceMap&, const EvidenceMap&) = default;
};

struct GridReport {
  GridLists lists;
  EvidenceMap evidence;
  std::uint32_t map_epoch = 0;

  friend bool operator==(const GridReport&, const GridReport&) = default;
};

}  // namespace seeker::api
