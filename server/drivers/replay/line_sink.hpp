/// \file
/// Text into a file that is being recorded, plain or compressed with gzip.
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "common/core/result.hpp"

namespace seeker::drivers {

/// A file that grows. What was flushed can be read even if the program is killed.
class LineSink {
 public:
  /// Creates the file, compressed where its name ends in .gz. A recording is never overwritten: where the name is
  /// taken, the file becomes NAME-2, NAME-3 and so on. kIo: it cannot be created.
  [[nodiscard]] static Result<LineSink> create(const std::filesystem::path& path);
  LineSink(LineSink&&) noexcept;
  LineSink& operator=(LineSink&&) noexcept;
  ~LineSink();

  /// Writes the text and hands it to the operating system. kIo: the disk is full or gone.
  [[nodiscard]] Status write_and_flush(std::string_view text);
  /// The name that the file got.
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  struct File;
  LineSink(std::unique_ptr<File> file, std::filesystem::path path);

  std::unique_ptr<File> file_;
  std::filesystem::path path_;
};

}  // namespace seeker::drivers
