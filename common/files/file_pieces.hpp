/// \file
/// Files that are too large to be read as a whole: read, and written, piece by piece.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <utility>
#include <vector>

#include "common/core/result.hpp"
#include "common/files/file_descriptor.hpp"

namespace seeker::files {

/// By this a file is known again; another content has another one, but for changes within one tick of the file system's
/// clock, some milliseconds.
struct FileIdentity {
  std::uint64_t device = 0;
  std::uint64_t inode = 0;
  std::uint64_t size_bytes = 0;
  std::int64_t changed_ns = 0;

  friend bool operator==(const FileIdentity&, const FileIdentity&) = default;
};

/// A regular file, open for reading.
class FileReader {
 public:
  /// kNotFound: none there; kIo: no regular file, no permission.
  [[nodiscard]] static Result<FileReader> open(const std::filesystem::path& path);

  /// As the file is now. kIo.
  [[nodiscard]] Result<FileIdentity> identity() const;
  /// At most `limit_bytes` from `offset` on; fewer at the end of the file only. kIo.
  [[nodiscard]] Result<std::vector<std::uint8_t>> read(std::uint64_t offset, std::size_t limit_bytes) const;

 private:
  FileReader(std::filesystem::path path, FileDescriptor file) : path_(std::move(path)), file_(std::move(file)) {}

  std::filesystem::path path_;
  FileDescriptor file_;
};

/// Writes the bytes at `offset`, which is the end of the file or before it; the file ends with them, and is made where
/// `offset` is 0 and there is none. It is as it was when that fails (kIo: full disk, no permission), but for bytes
/// behind `offset`. There is no wait for the disk: after a power cut the bytes may be others.
[[nodiscard]] Status write_piece(const std::filesystem::path& path, std::uint64_t offset,
                                 std::span<const std::uint8_t> bytes);
/// Puts a file that was written in pieces in the place of `to`, so that it survives a power cut. kIo.
[[nodiscard]] Status put_in_place(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace seeker::files
