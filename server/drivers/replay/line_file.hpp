/// \file
/// Lines of a text file, plain or compressed with gzip.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "common/core/result.hpp"

namespace seeker::drivers {

/// A line that was skipped.
struct BadLine {
  std::uint64_t number = 0;  ///< first line = 1
  std::string reason;
};

/// Skipped lines of a file: their number, and the first few of them.
struct BadLines {
  static constexpr std::size_t kMaxExamples = 20;

  std::uint64_t count = 0;
  std::vector<BadLine> examples;

  void add(std::uint64_t number, std::string reason);
};

/// Reads line after line; memory is bounded by one line.
class LineFile {
 public:
  static constexpr std::size_t kMaxLine_bytes = 256 * 1024;
  enum class Line : std::uint8_t { kGood, kTooLong, kEnd };

  /// Opens a file. Errors: kNotFound or kIo, which name the file; kParse for text in UTF-16. A byte order mark of UTF-8
  /// is skipped.
  [[nodiscard]] static Result<LineFile> open(const std::filesystem::path& path);
  LineFile(LineFile&&) noexcept;
  LineFile& operator=(LineFile&&) noexcept;
  ~LineFile();

  /// Reads the next line without its end into `line`. kTooLong: the line was skipped.
  [[nodiscard]] Line next(std::string& line);
  /// Why the file ended early (cut or damaged compression); empty otherwise.
  [[nodiscard]] std::string damage() const;
  /// Number of the line that next() read last; first line = 1.
  [[nodiscard]] std::uint64_t number() const { return number_; }

 private:
  struct File;
  explicit LineFile(std::unique_ptr<File> file);
  [[nodiscard]] Line read(std::string& line);
  /// False where the mark states UTF-16.
  [[nodiscard]] bool skip_byte_order_mark();

  std::unique_ptr<File> file_;
  std::uint64_t number_ = 0;
};

}  // namespace seeker::drivers
