/// \file
/// A page written in Markdown, as far as the checks of the documents need it.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace seeker::docs {

/// A piece of a page with the line on which it begins, counted from 1.
struct Piece {
  std::size_t line = 0;
  std::string text;
};

struct Page {
  std::string path;  ///< from the top of the source tree
  std::vector<std::string> lines;
  std::vector<Piece> code;   ///< inline code, and lines of code blocks: one that ends with a backslash with the next
  std::vector<Piece> links;  ///< targets of links and pictures
  std::set<std::string> anchors;  ///< of the headings, as links name them
};

/// Inline code must begin and end on one line.
[[nodiscard]] Page parse_page(const std::string& path, std::string_view text);

/// Characters of a line of UTF-8.
[[nodiscard]] std::size_t columns(std::string_view line);

}  // namespace seeker::docs
