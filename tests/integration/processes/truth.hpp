/// \file
/// What really happened in a world that seeker-emulator hosts.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "common/core/pose2.hpp"

namespace seeker::testing {

/// One line of the emulator's truth.
struct TruthRow {
  double time_s = 0.0;
  int robot = 0;
  Point2 p_world = Point2::Zero();
  int contacts = 0;  ///< with obstacles, up to then
};

/// The whole lines of `file`, which the emulator may still be writing.
inline std::vector<TruthRow> read_truth(const std::filesystem::path& file) {
  std::vector<TruthRow> rows;
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    TruthRow row;
    double theta_rad = 0.0;
    if (words >> row.time_s >> row.robot >> row.p_world.x() >> row.p_world.y() >> theta_rad >> row.contacts) {
      rows.push_back(row);
    }
  }
  return rows;
}

}  // namespace seeker::testing
