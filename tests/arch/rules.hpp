/// \file
/// The rules of the architecture, over texts, so that they can be tried on made-up files.
#pragma once

#include <string>
#include <vector>

#include "tests/arch/layers.hpp"

namespace seeker::arch {

/// A file by its path from the top of the tree, e.g. "server/nav/grid.cpp".
struct SourceFile {
  std::string path;
  std::string text;
};

/// Longest main.cpp: it composes libraries and nothing else.
inline constexpr int kMaxMainLines = 60;

/// One sentence for each include, clock or length that is against the table, beginning with file and line.
[[nodiscard]] std::vector<std::string> check_source(const Layers& layers, const SourceFile& file);

/// One sentence for each seeker_library() in the CMakeLists.txt files whose folder is not in the table or whose DEPS go
/// where its folder may not.
[[nodiscard]] std::vector<std::string> check_targets(const Layers& layers, const std::vector<SourceFile>& cmake_lists);

}  // namespace seeker::arch
