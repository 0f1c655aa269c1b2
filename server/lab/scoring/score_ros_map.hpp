/// \file
/// Reader of maps of ROS map_server: a YAML file and a picture.
#pragma once

#include <cstdint>
#include <filesystem>

#include "common/core/grid.hpp"
#include "common/core/result.hpp"

namespace seeker::lab {

struct RosMap {
  Grid<std::uint8_t> occupied;  ///< 1 where a cell is a wall
  Grid<std::uint8_t> known;     ///< 1 where a cell is a wall or free
};

/// Reads NAME.yaml (map_server's format, yaw 0) and the PGM or PNG that it names, or that file with `.gz` appended.
/// Errors of the files; kParse: the file is no such map; kNotReady: no cell is occupied.
[[nodiscard]] Result<RosMap> read_ros_map(const std::filesystem::path& yaml);

}  // namespace seeker::lab
