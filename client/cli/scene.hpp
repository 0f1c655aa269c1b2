/// \file
/// The map of the robot with trajectory, evidence and detections, gathered for pictures and exports.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "client/cli/context.hpp"
#include "common/image/map_picture.hpp"

namespace seeker::cli {

/// Fetches the occupancy as one grid. Error: kTooLarge when the tiles lie too far apart for one picture.
[[nodiscard]] Result<std::optional<Grid<std::uint8_t>>> fetch_occupancy(const Context& context);

/// The content of a picture where the newest mission is an exploration and the robot still has evidence of a search.
enum class SceneOf : std::uint8_t {
  kMission,  ///< the newest mission: an exploration without evidence, with its own detections
  kEvidence  ///< the newest evidence, whichever mission gathered it
};

/// Fetches map, trajectory, grid lists, evidence, detections and pose, those that the robot has.
[[nodiscard]] Result<image::MapScene> fetch_scene(const Context& context, SceneOf of);

/// The pictures that export_map() writes.
struct MapPictures {
  bool png = true;
  bool map_server = true;  ///< NAME.pgm and NAME.yaml
};

/// Writes NAME.pgm, NAME.yaml and NAME.png; makes the folder when it is absent. Returns the written files. Error: kIo
/// before anything is written when one of them exists and is no export of the map (export_check.hpp).
[[nodiscard]] Result<std::vector<std::filesystem::path>> export_map(const Context& context, const std::string& name,
                                                                    const MapPictures& pictures = {});

/// Writes a picture as PNG into a folder that is made when absent, with a mark of common/image/export_mark.hpp.
[[nodiscard]] Status save_picture(const std::filesystem::path& path, const Image& picture, std::string_view mark);
/// Draws a scene into such a file, marked as an export of the map: as SVG where its name ends in .svg, else as PNG.
[[nodiscard]] Status save_scene(const std::filesystem::path& path, const image::MapScene& scene);

}  // namespace seeker::cli
