/// \file
/// The table of allowed includes, read from layers.txt.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "common/core/result.hpp"

namespace seeker::arch {

/// What one folder may include besides itself. `*` in libraries: every one.
struct Folder {
  std::set<std::string> folders;
  std::set<std::string> libraries;
};

struct Layers {
  std::map<std::string, std::vector<std::string>> libraries;  ///< name -> prefixes of its headers
  std::set<std::string> hidden;                               ///< libraries of .cpp files only
  std::set<std::string> everywhere;                           ///< libraries that anybody may include
  std::map<std::string, Folder> folders;                      ///< path -> what it may include
  std::set<std::string> pure;                                 ///< folders of algorithms

  /// The library a header belongs to; empty for none.
  [[nodiscard]] std::string library_of(const std::string& header) const;
  /// The deepest known folder a path lies in; empty for none.
  [[nodiscard]] std::string folder_of(const std::string& path) const;
};

/// kParse with the line for a malformed table, an unknown folder or library in it, or a cycle of folders.
[[nodiscard]] Result<Layers> parse_layers(const std::string& text);

}  // namespace seeker::arch
