/// \file
/// What one simulated exploration gave, as numbers and as curves over time: two files per run, from which every table
/// and figure is made.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/config/fields.hpp"
#include "common/core/result.hpp"

namespace seeker::lab {

struct ExploreResult {
  int schema = 2;
  std::string world;
  std::string strategy;
  std::uint64_t seed = 0;
  std::string settings;  ///< hash of everything that shapes the run; a file with another one is not reused

  std::string outcome;  ///< how the mission ended
  std::string cause;
  int unreachable = 0;  ///< places it names
  double robot_time_s = 0.0;
  double wall_time_s = 0.0;
  double path_length_m = 0.0;  ///< of the true robot

  double mean_error_m = 0.0;  ///< position, believed against true in the frame of the start, over time
  double max_error_m = 0.0;
  double final_error_m = 0.0;
  double mean_robot_trace = 0.0;  ///< of the robot's covariance (x, y, theta), m^2 and rad^2, over time
  double final_robot_trace = 0.0;
  double mean_feature_trace = 0.0;  ///< of a segment's covariance (across, direction), over segments and time
  double final_feature_trace = 0.0;
  double final_full_trace = 0.0;  ///< of the robot and all segments: grows with the map

  double reachable_wall_m = 0.0;  ///< see WallShare
  double mapped_wall_m = 0.0;
  double wall_share = 0.0;
  /// Path of the true robot until its map first held 0, 1, 2, ... per cent of the walls, looked at once a metre.
  std::vector<double> share_path_m;
  double false_wall_m = 0.0;
  double map_wall_m = 0.0;
  bool aligned = false;
  int segments = 0;
  int map_epoch = 0;  ///< how often a loop closure moved the map

  int decisions = 0;
  double decide_s = 0.0;  ///< processor time of all of deciding
  int contacts = 0;
  double min_clearance_m = 0.0;
  int events = 0;
  std::string event_hash;  ///< of the mission's log

  [[nodiscard]] double speed() const { return wall_time_s > 0.0 ? robot_time_s / wall_time_s : 0.0; }
  /// Path until the map held this share of the walls; the whole path where it never did.
  [[nodiscard]] double path_to_share_m(double share) const;
  [[nodiscard]] double decisions_per_s() const { return decide_s > 0.0 ? decisions / decide_s : 0.0; }
};
void describe(config::Fields& f, ExploreResult& result);

/// Atomic; load_run() reads it. Error: kIo.
[[nodiscard]] Status save(const std::filesystem::path& path, const ExploreResult& result);

/// One moment of a run.
struct ExploreSample {
  double time_s = 0.0;
  double error_m = 0.0;
  double robot_trace = 0.0;
  double feature_trace = 0.0;  ///< mean of a segment; 0 while there is none
  double full_trace = 0.0;
  double map_wall_m = 0.0;  ///< length of all segments

  friend bool operator==(const ExploreSample&, const ExploreSample&) = default;
};

/// CSV with a header line.
[[nodiscard]] std::string curves_csv(const std::vector<ExploreSample>& samples);
/// kParse: not such a text.
[[nodiscard]] Result<std::vector<ExploreSample>> parse_curves(std::string_view text);

/// Takes note that after `path_m` the map held `share` of the walls.
void note_share(ExploreResult& result, double share, double path_m);

/// Means over time and last values; zeros for no samples.
void add_curves(const std::vector<ExploreSample>& samples, ExploreResult& result);

}  // namespace seeker::lab
