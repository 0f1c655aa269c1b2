/// \file
/// Why the printed robot errs more than ours (spec S7: R3): one seed's survey and drive, seen by the robot as printed,
/// by the same with one printed choice after the other as ours, and by ours.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "server/lab/stereo_database/stereo_run.hpp"

namespace seeker::lab {

/// Errors of one robot.
struct BisectionRow {
  std::string name;   ///< printed, the choice that is as ours, or ours
  int landmarks = 0;  ///< salient ones
  double all_rms_m = 0.0;
  double salient_rms_m = 0.0;
  double salient_rms_rad = 0.0;
  double mean_inliers = 0.0;  ///< with the salient landmarks
};
void describe(config::Fields& f, BisectionRow& row);

struct BisectionResult {
  int schema = 1;
  std::uint64_t seed = 0;
  std::string settings;
  std::vector<BisectionRow> rows;  ///< printed first, ours last
};
void describe(config::Fields& f, BisectionResult& result);

/// A printed choice, with the fields of the section `stereo` that make it ours.
struct PrintedChoice {
  std::string name;
  std::vector<std::string> as_ours;  ///< overrides of the robot file
};
[[nodiscard]] const std::vector<PrintedChoice>& printed_choices();

/// Of the printed robot of a seed; `spec.paper` and `spec.smallest` are not read.
[[nodiscard]] Result<std::string> bisection_settings_of(const StereoSpec& spec);
[[nodiscard]] Result<BisectionResult> bisect_stereo(const StereoSpec& spec);

/// All rows, seed by seed.
[[nodiscard]] std::string bisection_csv(const std::vector<BisectionResult>& results);

}  // namespace seeker::lab
