/// \file
/// Results of one simulated search as numbers: a file for each run, from which every table is made.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/config/yaml.hpp"
#include "common/core/result.hpp"

namespace seeker::lab {

/// Score of a found target against the true one. Angles are in degrees, as they are reported.
struct FindScore {
  std::string target;
  double robot_time_s = 0.0;     ///< robot time of the sighting
  double bearing_map_deg = 0.0;  ///< theta_0, spec S3.5 eq (5)
  /// Unsigned difference between theta_0 and the direction from the robot's true pose at that moment to the target's
  /// centre.
  double bearing_error_deg = 0.0;
  double u_px = 0.0;
  double v_px = 0.0;
  double score = 0.0;
  double range_m = 0.0;  ///< true distance from the robot to the target at that moment
  std::string range_source;
  std::optional<double> position_error_m;  ///< absent: the robot could not estimate the position
  std::optional<double> aligned_error_m;   ///< with --explore: the same after the map was aligned with the true walls
  /// Standard deviation reported by the robot: root of the covariance's largest eigenvalue.
  double position_sigma_m = 0.0;
  int cells_searched = 0;  ///< number of cells searched until then
};
void describe(config::Fields& f, FindScore& score);

struct RunResult {
  int schema = 1;
  std::string world;
  std::string strategy;
  std::uint64_t seed = 0;
  std::string settings;  ///< hash of everything that affects the run; a file with another hash is not reused

  bool found = false;   ///< the mission reports the target and a detection lies at a target
  int false_finds = 0;  ///< detections farther than 1 m from every target
  std::string outcome;
  std::string cause;
  double robot_time_s = 0.0;
  double wall_time_s = 0.0;
  double path_length_m = 0.0;  ///< path length of the true robot
  double target_path_m = 0.0;  ///< path length until the target was first reported; the whole path where it was not

  int cells_searched = 0;  ///< length of the list of spec S3.3
  int cells_unsearched = 0;
  int cells_unreachable = 0;
  int cells_visited = 0;   ///< distinct 0.8 m cells of the world that the true path entered
  int cells_repeated = 0;  ///< entries into one of them after the first

  double reachable_area_m2 = 0.0;       ///< in the robot's own map
  double covered_share = 0.0;           ///< share of it with evidence at or above the threshold
  double true_reachable_area_m2 = 0.0;  ///< in the world, for the robot's radius
  /// Covered area divided by that area; may exceed 1 a little, because the rasters differ.
  double covered_true_share = 0.0;
  double mean_probability = 0.0;
  int gaps = 0;

  int contacts = 0;
  double min_clearance_m = 0.0;
  double localisation_error_m = 0.0;  ///< at the end
  double localisation_error_deg = 0.0;
  double max_localisation_error_m = 0.0;

  std::optional<FindScore> first_find;  ///< first report of the target
  std::optional<FindScore> last_find;   ///< report at the end of the mission
  int events = 0;
  std::string event_hash;  ///< hash of the mission's log: kinds, texts, severities, mission times

  [[nodiscard]] double speed() const { return wall_time_s > 0.0 ? robot_time_s / wall_time_s : 0.0; }
};
void describe(config::Fields& f, RunResult& result);

/// Writes the file atomically. Error: kIo.
[[nodiscard]] Status save(const std::filesystem::path& path, const RunResult& result);

}  // namespace seeker::lab
