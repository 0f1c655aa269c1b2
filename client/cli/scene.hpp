/// \file
/// The map of the robot with trajectory, evidence and detections, gathered for pictures and exports.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "client/cli/context.hpp"
#include "common/image/map_picture.hpp"

namespace seeker::cli {

/// Fetches the occupancy as one grid. Error: as join_tiles().
[[nodiscard]] Result<std::optional<Grid<std::uint8_t>>> fetch_occupancy(const Context& context);

/// Puts tiles of occupancy together; absent when there are none. Error: kTooLarge when they lie too far apart for one
/// picture.
[[nodiscard]] Result<std::optional<Grid<std::uint8_t>>> join_tiles(const std::vector<OccupancyTile>& tiles);

/// How a detection is drawn.
[[nodiscard]] image::DetectionMark mark_of(const api::Detection& detection);

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
/// Draws into such a file: as SVG by `shapes` where its name ends in .svg, else as PNG by `pixels`.
[[nodiscard]] Status save_drawing(const std::filesystem::path& path, std::string_view mark,
                                  const std::function<Result<Image>()>& pixels,
                                  const std::function<Result<std::string>()>& shapes);
/// Draws a scene with save_drawing(), marked as an export of the map.
[[nodiscard]] Status save_scene(const std::filesystem::path& path, const image::MapScene& scene);

/// Writes a scene in formats of pgm, png and svg, after check_map_export() has passed: NAME.pgm with NAME.yaml where
/// the scene has occupancy, NAME.png and NAME.svg. Returns the written files.
[[nodiscard]] Result<std::vector<std::filesystem::path>> export_scene(const image::MapScene& scene,
                                                                      const std::string& name,
                                                                      const std::vector<std::string>& formats);

}  // namespace seeker::cli
