/// \file
/// What `seeker-lab slam` leaves: report, trajectory and picture of the map.
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

/// Fields of the JSON.
void describe(config::Fields& f, TimeFigures& times);

/// Where a run came from.
struct SlamSource {
  std::filesystem::path log;
  std::filesystem::path robot_file;
  std::string estimator;
  drivers::ReplayParams geometry;
  nav::OccupancyParams occupancy;
};

[[nodiscard]] std::string slam_json(const SlamSource& source, const SlamRun& run);
[[nodiscard]] std::string slam_text(const SlamSource& source, const SlamRun& run);

/// Occupancy of all scans at the poses known at the end; nothing where no scan has a pose. Errors of the log.
[[nodiscard]] Result<std::optional<Grid<std::uint8_t>>> slam_occupancy(const SlamSource& source, const SlamRun& run);
/// That occupancy with the way that was driven.
[[nodiscard]] Result<Image> slam_picture(const SlamSource& source, const SlamRun& run,
                                         const std::optional<Grid<std::uint8_t>>& occupancy);
/// The walls in the frame `map` for `seeker-lab score-map`: the segments as `x1,y1,x2,y2`, or without any the centres
/// of the occupied cells as `x,y`.
[[nodiscard]] std::string walls_csv(const SlamRun& run, const std::optional<Grid<std::uint8_t>>& occupancy);

/// Writes trajectory.tum, trajectory_online.tum where it differs, walls.csv, report.json and map.png into the folder.
[[nodiscard]] Status save_slam(const std::filesystem::path& folder, const SlamSource& source, const SlamRun& run);

}  // namespace seeker::lab
