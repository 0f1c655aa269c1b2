/// \file
/// Everything the robot knows about its map, gathered for pictures and exports.
#pragma once

#include <filesystem>
#include <optional>

#include "client/cli/context.hpp"
#include "common/image/map_picture.hpp"

namespace seeker::cli {

/// The occupancy as one grid. Error: kTooLarge when the tiles lie too far apart to be one picture.
[[nodiscard]] Result<std::optional<Grid<std::uint8_t>>> fetch_occupancy(const Context& context);

/// What a picture is of, when the newest mission is an exploration and the robot still has evidence of a search.
enum class SceneOf : std::uint8_t {
  kMission,  ///< the newest mission: an exploration without evidence, and with what it has found itself
  kEvidence  ///< the newest evidence, whichever mission gathered it
};

/// Map, trajectory, grid lists, evidence, detections and pose; what the robot does not have is left out.
[[nodiscard]] Result<image::MapScene> fetch_scene(const Context& context, SceneOf of);

/// Which of its pictures export_map() writes.
struct MapPictures {
  bool png = true;
  bool map_server = true;  ///< NAME.pgm and NAME.yaml
};

/// Writes NAME.pgm, NAME.yaml and NAME.png; makes the folder when it is absent. The written files are the answer.
[[nodiscard]] Result<std::vector<std::filesystem::path>> export_map(const Context& context, const std::string& name,
                                                                    const MapPictures& pictures = {});

/// Makes the folder that a file is to lie in.
[[nodiscard]] Status make_folder_of(const std::filesystem::path& path);

/// Makes the folder of what export_map() will write as NAME.png, .pgm and .yaml, and says now when they cannot be
/// written. Error: kIo.
[[nodiscard]] Status check_can_write(const std::string& name);

/// Writes a picture as PNG into a folder that is made when absent.
[[nodiscard]] Status save_picture(const std::filesystem::path& path, const Image& picture);

}  // namespace seeker::cli
