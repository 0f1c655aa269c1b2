/// \file
/// A folder of files of one kind that users refer to by name, each as NAME.ending.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/core/result.hpp"

namespace seeker::store {

/// The kind of the files, for messages.
struct FileKind {
  std::string ending;  ///< with its dot
  std::string name;    ///< "map"
  std::string folder;  ///< "folder of maps"
  std::string none;    ///< message where there is none: "none has been saved yet ('seeker map save NAME')"
};

/// The folder is made by make_folder() only. Names are those of validate_map_name().
class NamedFiles {
 public:
  NamedFiles(std::filesystem::path folder, FileKind kind) : folder_(std::move(folder)), kind_(std::move(kind)) {}

  /// Sorted names of all files; an absent folder has none. kIo.
  [[nodiscard]] Result<std::vector<std::string>> names() const;
  [[nodiscard]] std::filesystem::path path_of(const std::string& name) const { return folder_ / (name + kind_.ending); }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// Checks that a file exists. kNotFound lists the files there are; kInvalidArgument: not a valid name.
  [[nodiscard]] Status check_present(const std::string& name) const;
  /// Checks that a file may be written. kRefused: there is one of this name, and `replace` is false.
  [[nodiscard]] Status check_free(const std::string& name, bool replace) const;
  /// Makes the folder. kIo.
  [[nodiscard]] Status make_folder() const;
  [[nodiscard]] Status remove(const std::string& name) const;

 private:
  std::filesystem::path folder_;
  FileKind kind_;
};

}  // namespace seeker::store
