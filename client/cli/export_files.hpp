/// \file
/// Files made of what the robot knows about its map, for other programs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "client/cli/context.hpp"

namespace seeker::cli {

/// What `seeker map export --format` takes: pgm, png, svg, geojson, tum. Writes NAME.pgm with NAME.yaml (pgm),
/// NAME.png, NAME.svg, NAME.geojson and NAME.tum, as far as asked for; makes the folder when it is absent. The written
/// files are the answer. kNotReady: svg and geojson where the estimator keeps no map of segments, tum where nothing was
/// driven.
[[nodiscard]] Result<std::vector<std::filesystem::path>> export_map_files(const Context& context,
                                                                          const std::string& name,
                                                                          const std::vector<std::string>& formats);

/// One line per pose: "time x y z qx qy qz qw", time in seconds of robot time, as the TUM tools read it.
[[nodiscard]] std::string trajectory_tum(const std::vector<api::StampedPose>& trajectory);

}  // namespace seeker::cli
