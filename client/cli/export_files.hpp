/// \file
/// Exports of the map of the robot for other programs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "client/cli/context.hpp"

namespace seeker::cli {

/// What `seeker map export --format` takes: pgm, png, svg, geojson, tum. Writes NAME.pgm with NAME.yaml (pgm),
/// NAME.png, NAME.svg, NAME.geojson and NAME.tum, those of the given formats; makes the folder when it is absent.
/// Returns the written files. kIo, before anything is written, when one of them exists and is no export of the map
/// (export_check.hpp). kNotReady: svg and geojson where the estimator keeps no map of segments, tum where the robot has
/// not driven.
[[nodiscard]] Result<std::vector<std::filesystem::path>> export_map_files(const Context& context,
                                                                          const std::string& name,
                                                                          const std::vector<std::string>& formats);

/// A trajectory in the format of the TUM tools: one line "time x y z qx qy qz qw" per pose, time in seconds of robot
/// time.
[[nodiscard]] std::string trajectory_tum(const std::vector<api::StampedPose>& trajectory);

}  // namespace seeker::cli
