/// \file
/// Results of one simulated exploration as numbers and as curves over time: two files for each run, from which every
/// table and figure is made.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/config/fields.hpp"
#include "common/core/result.hpp"

namespace seeker::lab {

struct ExploreResult {
  int schema = 4;
  std::string world;
  std::string strategy;
  std::uint64_t seed = 0;
  std::string settings;  ///< hash of everything that affects the run; a file with another hash is not reused

  std::string outcome;  ///< how the mission ended
  std::string cause;
  int unreachable = 0;  ///< number of places that the mission reports as unreachable
  double robot_time_s = 0.0;
  double wall_time_s = 0.0;
  double path_length_m = 0.0;  ///< path length of the true robot
  double along_wall_m = 0.0;   ///< part of it that was driven in wall following

  /// Mean over time of the position error, estimated against true, in the frame of the start.
  double mean_error_m = 0.0;
  double max_error_m = 0.0;
  double final_error_m = 0.0;
  /// Mean over time of the trace of the robot's covariance (x, y, theta), m^2 and rad^2.
  double mean_robot_trace = 0.0;
  double final_robot_trace = 0.0;
  /// Trace of a segment's covariance (across, direction), mean over segments and time.
  double mean_feature_trace = 0.0;
  double final_feature_trace = 0.0;
  double final_full_trace = 0.0;  ///< trace of the covariance of the robot and all segments; it grows with the map

  double reachable_wall_m = 0.0;  ///< see WallShare
  double mapped_wall_m = 0.0;
  double wall_share = 0.0;
  /// Path length of the true robot until its map first held 0, 1, 2, ... per cent of the walls, checked at every metre.
  std::vector<double> share_path_m;
  double false_wall_m = 0.0;
  double map_wall_m = 0.0;
  double floor_m2 = 0.0;  ///< floor that the map shows as free at the end
  bool aligned = false;
  int segments = 0;
  int map_epoch = 0;  ///< number of loop closures that corrected the map

  int decisions = 0;
  double decide_s = 0.0;  ///< processor time of all decisions
  int contacts = 0;
  double min_clearance_m = 0.0;
  int events = 0;
  std::string event_hash;  ///< hash of the mission's log

  [[nodiscard]] double speed() const { return wall_time_s > 0.0 ? robot_time_s / wall_time_s : 0.0; }
  /// Path length until the map held this share of the walls; the whole path where it never did.
  [[nodiscard]] double path_to_share_m(double share) const;
  [[nodiscard]] double decisions_per_s() const { return decide_s > 0.0 ? decisions / decide_s : 0.0; }
};
void describe(config::Fields& f, ExploreResult& result);

/// Writes the file atomically; load_run() reads it. Error: kIo.
[[nodiscard]] Status save(const std::filesystem::path& path, const ExploreResult& result);

/// One moment of a run.
struct ExploreSample {
  double time_s = 0.0;
  double error_m = 0.0;
  double robot_trace = 0.0;
  double feature_trace = 0.0;  ///< mean over segments; 0 while there is none
  double full_trace = 0.0;
  double map_wall_m = 0.0;  ///< length of all segments
  double path_m = 0.0;      ///< path length of the true robot so far
  double floor_m2 = 0.0;    ///< floor that the map shows as free

  friend bool operator==(const ExploreSample&, const ExploreSample&) = default;
};

/// One run's curves, and their name in a figure.
struct NamedCurve {
  std::string name;
  std::vector<ExploreSample> samples;
};

/// CSV with a header line.
[[nodiscard]] std::string curves_csv(const std::vector<ExploreSample>& samples);
/// Parses the text of curves_csv(). kParse: the text has another form.
[[nodiscard]] Result<std::vector<ExploreSample>> parse_curves(std::string_view text);

/// Records that the map held `share` of the walls after `path_m`.
void note_share(ExploreResult& result, double share, double path_m);

/// Computes means over time and last values; zeros for no samples.
void add_curves(const std::vector<ExploreSample>& samples, ExploreResult& result);

}  // namespace seeker::lab
