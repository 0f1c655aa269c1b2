/// \file
/// Command `seeker-lab survey`: makes a database of landmarks from recorded pairs of pictures with known poses (spec
/// S2.4-S2.7).
#pragma once

#include <cstdint>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "common/core/result.hpp"

namespace seeker::lab {

struct SurveyOptions {
  std::filesystem::path folder;  ///< folder of the pairs
  /// Names of the left pictures; `*` is the part that the names of a pair have in common.
  std::string left = "*_left.*";
  std::string right = "*_right.*";
  std::string poses = "poses.csv";  ///< file in the folder: name,x_m,y_m,theta_deg of the left eye
  /// File of `seeker-lab calibrate`; empty: the pictures are rectified and have the geometry of the robot file.
  std::filesystem::path calibration;
  std::string name;             ///< name of the database
  std::filesystem::path out;    ///< folder to write NAME.seekerlm into
  std::filesystem::path robot;  ///< robot file with the section `stereo`
  std::vector<std::string> overrides;
  bool replace = false;
  bool json = false;
  bool show_progress = false;
};

/// Numbers of features and landmarks of a survey (spec S2.11, Table 2).
struct SurveyFigures {
  std::uint64_t pairs = 0;
  std::uint64_t features = 0;    ///< points with a depth, over all pairs
  std::uint64_t matched = 0;     ///< number of these that matched existing landmarks
  std::uint64_t sparsified = 0;  ///< rejected by the sparsity rule
  std::uint64_t all = 0;         ///< landmarks before the test of salience
  std::uint64_t salient = 0;     ///< landmarks kept
  std::string file;
};

/// Prints the figures. Errors: those of the files, which are named; kInvalidArgument: a pair that cannot be used, with
/// its name.
[[nodiscard]] Status run_survey(const SurveyOptions& options, std::ostream& out);

}  // namespace seeker::lab
