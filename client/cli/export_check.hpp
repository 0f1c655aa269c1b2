/// \file
/// Says before anything is written whether files of an export can be: a file beside the user's own of the same name
/// is not overwritten unless it is an older export of the same kind.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/result.hpp"

namespace seeker::cli {

/// Makes the folder that a file is to lie in.
[[nodiscard]] Status make_folder_of(const std::filesystem::path& path);

/// Makes the folder of each file. Error: kIo, with a remedy, for the first one that cannot be written, or that is there
/// without the mark of such exports (common/image/export_mark.hpp).
[[nodiscard]] Status check_replaceable(const std::vector<std::filesystem::path>& files, std::string_view mark);

/// The files that an export of the map under `name` writes in these formats (pgm, png, svg, geojson, tum).
[[nodiscard]] std::vector<std::filesystem::path> map_export_files(const std::string& name,
                                                                  const std::vector<std::string>& formats);

/// check_replaceable() for these files.
[[nodiscard]] Status check_map_export(const std::string& name,
                                      const std::vector<std::string>& formats = {"png", "pgm"});

}  // namespace seeker::cli
