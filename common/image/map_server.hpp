/// \file
/// Maps in the format of ROS map_server: a PGM picture and a YAML file beside it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "common/core/grid.hpp"
#include "common/core/image.hpp"
#include "common/core/result.hpp"

namespace seeker::image {

/// Thresholds written to the YAML and used to choose the grey values.
inline constexpr double kOccupiedThreshold = 0.65;
inline constexpr double kFreeThreshold = 0.196;
inline constexpr std::uint8_t kPgmOccupied = 0;
inline constexpr std::uint8_t kPgmFree = 254;
inline constexpr std::uint8_t kPgmUnknown = 205;

/// The grid (probability of occupied * 254, 255 unknown) as grey values; the picture's first row is the grid's last.
[[nodiscard]] Image map_server_image(const Grid<std::uint8_t>& occupancy);
/// The YAML text: `pgm_name` relative to it, origin = lower left corner of the grid, yaw 0.
[[nodiscard]] std::string map_server_yaml(const std::string& pgm_name, const GridFrame& frame);
/// Writes `prefix`.pgm and `prefix`.yaml. Errors: kNotReady for an empty map, kIo.
[[nodiscard]] Status write_map_server(const std::filesystem::path& prefix, const Grid<std::uint8_t>& occupancy);

}  // namespace seeker::image
