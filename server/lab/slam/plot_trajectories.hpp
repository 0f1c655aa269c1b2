/// \file
/// Pictures of several trajectories together, and of one scan with its lines.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "common/core/grid.hpp"
#include "common/core/image.hpp"
#include "common/core/result.hpp"
#include "common/core/scan.hpp"
#include "server/lab/scoring/trajectory.hpp"
#include "server/lines/line.hpp"

namespace seeker::lab {

struct NamedTrajectory {
  std::string name;
  Trajectory poses;
};

/// Draws the trajectories in the frame of the first, with a scale and the length of each, above `walls`. kNotReady:
/// there is nothing to draw; kTooLarge: the picture would exceed 5 km.
[[nodiscard]] Result<Image> draw_trajectories(const std::vector<NamedTrajectory>& trajectories,
                                              const std::optional<Grid<std::uint8_t>>& walls);

/// Draws the returns of the scan as points and its lines with their ends, in the frame `laser`. kNotReady: no returns.
[[nodiscard]] Result<Image> draw_scan(const LaserScan& scan, const lines::ScanLines& found, const std::string& title);

struct PlotOptions {
  std::vector<std::filesystem::path> trajectories;
  std::filesystem::path log;  ///< log whose scans at the poses of the first trajectory are drawn as walls; may be empty
  std::filesystem::path robot;
  std::filesystem::path config;
  std::vector<std::string> overrides;
  std::filesystem::path out;
  bool align = false;  ///< whether each trajectory is moved onto the first by the best rigid motion
};

/// Draws what the options name into a PNG file and prints its name. Errors of the files.
[[nodiscard]] Status run_plot(const PlotOptions& options, std::ostream& out);

}  // namespace seeker::lab
