/// \file
/// Paths of the source tree in the code of a page.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace seeker::docs {

/// Words that look like paths of the source tree: they begin with a folder of its top.
[[nodiscard]] std::vector<std::string> source_paths_in(std::string_view code);

/// Whether there is such a file or folder below `top`. A star, or a word in capitals where nothing has that very name,
/// stands for any name.
[[nodiscard]] bool exists_in_tree(const std::filesystem::path& top, const std::string& path);

}  // namespace seeker::docs
