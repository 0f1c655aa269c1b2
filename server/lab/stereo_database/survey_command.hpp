/// \file
/// seeker-lab survey: a database of landmarks from recorded pairs of pictures whose poses are known (spec S2.4-S2.7).
#pragma once

#include <cstdint>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "common/core/result.hpp"

namespace seeker::lab {

struct SurveyOptions {
  std::filesystem::path folder;   ///< of the pairs
  std::string left = "*_left.*";  ///< names of the left pictures; `*` is what a pair has in common
  std::string right = "*_right.*";
  std::string poses = "poses.csv";  ///< in the folder: name,x_m,y_m,theta_deg of the left eye
  std::filesystem::path
      calibration;              ///< of `seeker-lab calibrate`; empty: rectified already, geometry as in the robot file
  std::string name;             ///< of the database
  std::filesystem::path out;    ///< folder to write NAME.seekerlm into
  std::filesystem::path robot;  ///< robot file with the section `stereo`
  std::vector<std::string> overrides;
  bool replace = false;
  bool json = false;
  bool show_progress = false;
};

/// What a survey made of its pictures (spec S2.11, Table 2).
struct SurveyFigures {
  std::uint64_t pairs = 0;
  std::uint64_t features = 0;    ///< points with a depth, over all pairs
  std::uint64_t matched = 0;     ///< of these, landmarks that were there
  std::uint64_t sparsified = 0;  ///< refused by the sparsity rule
  std::uint64_t all = 0;         ///< landmarks before the test of salience
  std::uint64_t salient = 0;     ///< landmarks kept
  std::string file;
};

/// Prints the figures. Errors of the files, named; kInvalidArgument: a pair that cannot be used, with its name.
[[nodiscard]] Status run_survey(const SurveyOptions& options, std::ostream& out);

}  // namespace seeker::lab
