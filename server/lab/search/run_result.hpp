/// \file
/// What one simulated search gave, as numbers: a file per run, from which every table is made.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/config/yaml.hpp"
#include "common/core/result.hpp"

namespace seeker::lab {

/// How a found target was scored against the truth. Angles are in degrees, as they are reported.
struct FindScore {
  std::string target;
  double robot_time_s = 0.0;     ///< of the sighting
  double bearing_map_deg = 0.0;  ///< theta_0, spec S3.5 eq (5)
  /// theta_0 against the direction to the target's centre from the robot's true pose at that moment, unsigned.
  double bearing_error_deg = 0.0;
  double u_px = 0.0;
  double v_px = 0.0;
  double score = 0.0;
  double range_m = 0.0;  ///< true distance robot to target at that moment
  std::string range_source;
  std::optional<double> position_error_m;  ///< absent: the robot could not say where it stands
  std::optional<double> aligned_error_m;   ///< the same after the map was laid on the true walls, of --explore
  double position_sigma_m = 0.0;           ///< what the robot believes: root of the covariance's largest eigenvalue
  int cells_searched = 0;                  ///< up to then
};
void describe(config::Fields& f, FindScore& score);

struct RunResult {
  int schema = 1;
  std::string world;
  std::string strategy;
  std::uint64_t seed = 0;
  std::string settings;  ///< hash of everything that shapes the run; a file with another one is not reused

  bool found = false;   ///< the mission says so and a detection lies at a target
  int false_finds = 0;  ///< detections farther than 1 m from every target
  std::string outcome;
  std::string cause;
  double robot_time_s = 0.0;
  double wall_time_s = 0.0;
  double path_length_m = 0.0;  ///< of the true robot
  double target_path_m = 0.0;  ///< driven until the target was first reported; the whole path where it was not

  int cells_searched = 0;  ///< length of the list of spec S3.3
  int cells_unsearched = 0;
  int cells_unreachable = 0;
  int cells_visited = 0;   ///< distinct 0.8 m cells of the world that the true path entered
  int cells_repeated = 0;  ///< entries into one of them after the first

  double reachable_area_m2 = 0.0;       ///< by the robot's own map
  double covered_share = 0.0;           ///< of it, with evidence at or above the threshold
  double true_reachable_area_m2 = 0.0;  ///< by the world, for the robot's radius
  double covered_true_share = 0.0;      ///< covered area by that one; may exceed 1 a little (rasters differ)
  double mean_probability = 0.0;
  int gaps = 0;

  int contacts = 0;
  double min_clearance_m = 0.0;
  double localisation_error_m = 0.0;  ///< at the end
  double localisation_error_deg = 0.0;
  double max_localisation_error_m = 0.0;

  std::optional<FindScore> first_find;  ///< the first report of the target
  std::optional<FindScore> last_find;   ///< what the mission ends with
  int events = 0;
  std::string event_hash;  ///< of the mission's log: kinds, texts, severities, mission times

  [[nodiscard]] double speed() const { return wall_time_s > 0.0 ? robot_time_s / wall_time_s : 0.0; }
};
void describe(config::Fields& f, RunResult& result);

/// Atomic. Error: kIo.
[[nodiscard]] Status save(const std::filesystem::path& path, const RunResult& result);

}  // namespace seeker::lab
