/// \file
/// What one seed of the stereo experiment gave: numbers in one file, curves and rows of the tables beside it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/config/fields.hpp"
#include "common/core/result.hpp"
#include "server/localize/landmark_database.hpp"

namespace seeker::lab {

/// One drive localised with one database (spec S2.11, Table 3).
struct DatabaseScore {
  std::string name;  ///< all, sparse, salient, changed, outdated, updated
  int landmarks = 0;
  int frames = 0;
  double rms_x_m = 0.0;
  double rms_y_m = 0.0;
  double rms_m = 0.0;
  double rms_rad = 0.0;
  double mean_nees = 0.0;  ///< of (x, y, theta): 3 where the filter tells its error
  double mean_inliers = 0.0;
  double mean_compared = 0.0;   ///< features of a frame times landmarks that should show in it: association's work
  double median_step_ms = 0.0;  ///< association and update of a frame, its features apart
  int not_localised = 0;        ///< frames that were not LOCALISED
  int unnoticed = 0;            ///< frames that were LOCALISED and wrong by more than kUnnoticed_m or kUnnoticed_rad
};
void describe(config::Fields& f, DatabaseScore& score);

inline constexpr double kUnnoticed_m = 0.25;
inline constexpr double kUnnoticed_rad = 0.087;  ///< 5 degrees

struct StereoResult {
  int schema = 2;    ///< 2: with mean_compared
  std::string mode;  ///< default or paper
  std::uint64_t seed = 0;
  std::string settings;

  std::vector<DatabaseScore> scores;
  int dynamic = 0;  ///< landmarks of the drive through the changed room
  int duplicates = 0;
  int added = 0;
  int removed = 0;
  int before = 0;
  int after = 0;
  std::string refused;  ///< why there was no update; empty: there was

  int places = 0;  ///< of the surveyed room, at which a robot woke up and turned about until it was LOCALISED
  int places_found = 0;
  int places_wrong = 0;   ///< found, and off by more than stereo::kWrongPlace_m or stereo::kWrongPlace_rad
  int at_once = 0;        ///< places that the first view alone told
  int at_once_wrong = 0;  ///< and told wrong
  int looks = 0;          ///< of all that turned about
  int looks_refused = 0;  ///< of these: pictures that the check of the camera did not let pass
  int looks_most = 0;     ///< of one of them
  int foreign = 0;        ///< single views of rooms never surveyed
  int foreign_found = 0;
  int foreign_empty = 0;       ///< of the views: no feature in them
  double relocalise_ms = 0.0;  ///< of a single view, its features apart; median

  [[nodiscard]] const DatabaseScore* find(std::string_view name) const;
};
void describe(config::Fields& f, StereoResult& result);
[[nodiscard]] Status save(const std::filesystem::path& path, const StereoResult& result);

/// Error of one frame, for Fig 13.
struct ErrorSample {
  double time_s = 0.0;
  double x_m = 0.0;
  double y_m = 0.0;
  double theta_rad = 0.0;
};
struct ErrorCurve {
  std::string name;
  std::vector<ErrorSample> samples;
};

/// Plan of a database, for Figs 4, 6, 8.
struct DatabasePlan {
  std::string name;
  std::vector<Point2> landmarks;
};

/// Everything of one seed.
struct StereoRecord {
  StereoResult result;
  std::string table1_csv;  ///< matches of every frame before and after the constraints
  std::string table2_csv;  ///< what became of the features of every view of the survey
  std::vector<DatabasePlan> plans;
  std::vector<ErrorCurve> curves;
  std::vector<Point2> way;  ///< of the robot, true
};

}  // namespace seeker::lab
