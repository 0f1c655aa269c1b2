/// \file
/// The file under which a new version of another one is written, until it takes that one's place.
#pragma once

#include <cstddef>
#include <filesystem>

#include "common/core/result.hpp"
#include "common/files/file_descriptor.hpp"
#include "common/files/files.hpp"

namespace seeker::files {

/// Lies beside the file it is for, as NAME.tmp-XXXXXX. It is locked while this object lives, so that what a killed
/// program has left behind can be distinguished from what another one is writing; removed when this object ends.
class TemporaryFile {
 public:
  /// Makes an empty one for `path`. kIo.
  [[nodiscard]] static Result<TemporaryFile> beside(const std::filesystem::path& path,
                                                    ReadableBy readers = ReadableBy::kAll);
  TemporaryFile(TemporaryFile&& other) noexcept;
  TemporaryFile& operator=(TemporaryFile&&) = delete;
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// For writing and syncing; not to be closed.
  [[nodiscard]] int descriptor() const { return file_.get(); }
  /// Closes it and gives it the place of `path`. What was written outlives a power cut only if it was synced before.
  /// kIo: `path` is as it was.
  [[nodiscard]] Status move_to(const std::filesystem::path& path);

 private:
  TemporaryFile(std::filesystem::path path, FileDescriptor file) : path_(std::move(path)), file_(std::move(file)) {}

  std::filesystem::path path_;  ///< empty once moved
  FileDescriptor file_;
};

/// Removes what killed programs have left of temporary files in `folder` and the folders below; those that are being
/// written stay. The number of files removed; 0 where there is no folder.
std::size_t remove_left_over(const std::filesystem::path& folder);

}  // namespace seeker::files
