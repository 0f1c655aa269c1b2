/// \file
/// Output of `seeker-lab slam`: report, trajectory and picture of the map.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "common/config/fields.hpp"
#include "common/core/grid.hpp"
#include "common/core/image.hpp"
#include "common/core/result.hpp"
#include "server/lab/slam/slam_run.hpp"
#include "server/nav/occupancy_map.hpp"

namespace seeker::lab {

/// Describes the fields of the JSON.
void describe(config::Fields& f, TimeFigures& times);

/// The inputs of a run.
struct SlamSource {
  std::filesystem::path log;
  std::filesystem::path robot_file;
  std::string estimator;
  drivers::ReplayParams geometry;
  nav::OccupancyParams occupancy;
};

[[nodiscard]] std::string slam_json(const SlamSource& source, const SlamRun& run);
[[nodiscard]] std::string slam_text(const SlamSource& source, const SlamRun& run);

/// Occupancy of all scans at the poses known at the end. Nothing: no scan has a pose. Errors of the log.
[[nodiscard]] Result<std::optional<Grid<std::uint8_t>>> slam_occupancy(const SlamSource& source, const SlamRun& run);
/// Picture of that occupancy with the driven path.
[[nodiscard]] Result<Image> slam_picture(const SlamSource& source, const SlamRun& run,
                                         const std::optional<Grid<std::uint8_t>>& occupancy);
/// The walls in the frame `map` for `seeker-lab score-map`: the segments as `x1,y1,x2,y2`, or, where there are none,
/// the centres of the occupied cells as `x,y`.
[[nodiscard]] std::string walls_csv(const SlamRun& run, const std::optional<Grid<std::uint8_t>>& occupancy);

/// Writes trajectory.tum, trajectory_online.tum where it differs, walls.csv, report.json and map.png into the folder.
[[nodiscard]] Status save_slam(const std::filesystem::path& folder, const SlamSource& source, const SlamRun& run);

}  // namespace seeker::lab
