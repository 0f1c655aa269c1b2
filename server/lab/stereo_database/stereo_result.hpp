/// \file
/// Results of one seed of the stereo experiment: numbers in one file, curves and rows of the tables beside it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/config/fields.hpp"
#include "common/core/image.hpp"
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
  double mean_nees = 0.0;  ///< mean NEES of (x, y, theta): 3 for a consistent filter
  double mean_inliers = 0.0;
  double mean_compared = 0.0;   ///< features of a frame times landmarks expected in it: the work of association
  double median_step_ms = 0.0;  ///< processor time of association and update of a frame, without its features
  int not_localised = 0;        ///< frames that were not LOCALISED
  double inside = 0.0;          ///< share of the landmarks that lie within the room (Figs 4, 6, 8)
  int unnoticed = 0;            ///< frames that were LOCALISED with an error above kUnnoticed_m or kUnnoticed_rad
};
void describe(config::Fields& f, DatabaseScore& score);

inline constexpr double kUnnoticed_m = 0.25;
inline constexpr double kUnnoticed_rad = 0.087;  ///< 5 degrees

struct StereoResult {
  int schema = 3;    ///< 2: with mean_compared; 3: with the survey's counts
  std::string mode;  ///< default or paper
  std::uint64_t seed = 0;
  std::string settings;

  int survey_pictures = 0;   ///< number of pairs of pictures of the survey (Table 1)
  int survey_before = 0;     ///< matches before the constraints, over all of them
  int survey_after = 0;      ///< matches after the constraints
  int survey_reduced = 0;    ///< number of pairs of which the constraints dropped matches
  int added_features = 0;    ///< of the four views of Fig 7: features that became landmarks and stayed,
  int known_features = 0;    ///< those that were associated with landmarks,
  int thinned_features = 0;  ///< and those that the sparsity rule refused or dropped
  int frames_shown = 0;      ///< number of frames of Fig 12 with a matched feature
  int frames_matched = 0;    ///< number of their features that corrected the pose
  int frames_unmatched = 0;  ///< number of their other features

  std::vector<DatabaseScore> scores;
  int dynamic = 0;  ///< number of dynamic landmarks in the drive through the changed room
  int duplicates = 0;
  int added = 0;
  int removed = 0;
  int before = 0;
  int after = 0;
  std::string refused;  ///< why there was no update; empty: there was one

  /// Number of places in the surveyed room at which a robot started and rotated until it was LOCALISED.
  int places = 0;
  int places_found = 0;
  int places_wrong = 0;   ///< found with an error above stereo::kWrongPlace_m or stereo::kWrongPlace_rad
  int at_once = 0;        ///< number of places that the first view alone gave
  int at_once_wrong = 0;  ///< number of these that were wrong
  int looks = 0;          ///< number of views of all rotating robots
  int looks_refused = 0;  ///< number of these that the check of the camera rejected
  int looks_most = 0;     ///< largest number of views of one robot
  int foreign = 0;        ///< number of single views of rooms that were never surveyed
  int foreign_found = 0;
  int foreign_empty = 0;       ///< number of these without features
  double relocalise_ms = 0.0;  ///< median time for a single view, without its features

  [[nodiscard]] const DatabaseScore* find(std::string_view name) const;
};

/// Mean of a figure of one database over the runs that have that database; 0 where none has it.
template <class T>
[[nodiscard]] double mean_score(const std::vector<StereoResult>& runs, std::string_view database,
                                T DatabaseScore::*figure) {
  double sum = 0.0;
  int count = 0;
  for (const StereoResult& run : runs) {
    if (const DatabaseScore* score = run.find(database)) {
      sum += static_cast<double>(score->*figure);
      ++count;
    }
  }
  return sum / std::max(1, count);
}
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

/// A figure that is a picture.
struct StereoPicture {
  std::string name;  ///< fig1, fig7, fig12
  Image image;
};

/// All results of one seed.
struct StereoRecord {
  StereoResult result;
  std::vector<StereoPicture> pictures;
  std::string table1_csv;  ///< matches of every pair of the survey before and after the constraints
  std::string table2_csv;  ///< use of the features of every view of the survey
  std::vector<DatabasePlan> plans;
  std::vector<ErrorCurve> curves;
  std::vector<Point2> path;  ///< true path of the robot
};

}  // namespace seeker::lab
