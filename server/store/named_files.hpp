/// \file
/// A folder of files of one kind that people know by name: NAME.ending each.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/core/result.hpp"

namespace seeker::store {

/// What the files are, for messages.
struct FileKind {
  std::string ending;  ///< with its dot
  std::string name;    ///< "map"
  std::string folder;  ///< "folder of maps"
  std::string none;    ///< what is said where there is none: "none has been saved yet ('seeker map save NAME')"
};

/// The folder is not made until somebody wants to write into it. Names are those of validate_map_name().
class NamedFiles {
 public:
  NamedFiles(std::filesystem::path folder, FileKind kind) : folder_(std::move(folder)), kind_(std::move(kind)) {}

  /// Sorted. An absent folder has none. kIo.
  [[nodiscard]] Result<std::vector<std::string>> names() const;
  [[nodiscard]] std::filesystem::path path_of(const std::string& name) const { return folder_ / (name + kind_.ending); }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// kNotFound tells which there are; kInvalidArgument for what cannot be a name.
  [[nodiscard]] Status check_present(const std::string& name) const;
  /// kRefused: there is one of this name already, and it is not to be replaced.
  [[nodiscard]] Status check_free(const std::string& name, bool replace) const;
  /// kIo.
  [[nodiscard]] Status make_folder() const;
  [[nodiscard]] Status remove(const std::string& name) const;

 private:
  std::filesystem::path folder_;
  FileKind kind_;
};

}  // namespace seeker::store
