#include "server/drivers/replay/carmen_reader.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <zlib.h>

namespace seeker::drivers {

/// A gzFile, which reads plain files as well, and the line being put together.
class CarmenReader::File {
 public:
  explicit File(gzFile file) : file_(file) {}
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File() { gzclose(file_); }

  enum class Line : std::uint8_t { kGood, kTooLong, kEnd };

  Line read_line(std::string& line) {
    line.clear();
    bool too_long = false;
    while (true) {
      if (gzgets(file_, buffer_.data(), static_cast<int>(buffer_.size())) == nullptr) {
        return line.empty() && !too_long ? Line::kEnd : finish(too_long);
      }
      // A zero byte ends the text early; what follows it in the buffer is lost, and the line turns out malformed.
      const std::string_view piece(buffer_.data());
      too_long = too_long || line.size() + piece.size() > kMaxLine_bytes;
      if (!too_long) {
        line += piece;
      }
      if (piece.empty() || piece.back() == '\n') {
        return finish(too_long);
      }
    }
  }
  [[nodiscard]] std::string damage() const {
    int code = Z_OK;
    const char* text = gzerror(file_, &code);
    return code == Z_OK || code == Z_STREAM_END ? std::string() : std::string(text);
  }

 private:
  static Line finish(bool too_long) { return too_long ? Line::kTooLong : Line::kGood; }

  gzFile file_;
  std::array<char, 16384> buffer_{};
};

Result<CarmenReader> CarmenReader::open(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    return fail(Errc::kNotFound, "there is no log file " + path.string());
  }
  gzFile file = gzopen(path.c_str(), "rb");
  if (file == nullptr) {
    return fail(Errc::kIo, "the log " + path.string() + " cannot be opened; check its permissions");
  }
  return CarmenReader(std::make_unique<File>(file));
}

CarmenReader::CarmenReader(std::unique_ptr<File> file) : file_(std::move(file)) {}
CarmenReader::CarmenReader(CarmenReader&&) noexcept = default;
CarmenReader& CarmenReader::operator=(CarmenReader&&) noexcept = default;
CarmenReader::~CarmenReader() = default;

void CarmenReader::count_bad(std::string reason) {
  ++summary_.bad;
  if (summary_.examples.size() < ReplaySummary::kMaxExamples) {
    summary_.examples.push_back({summary_.lines, std::move(reason)});
  }
}

void CarmenReader::reject_last(std::string reason) {
  --(last_was_scan_ ? summary_.scans : summary_.odometry);
  count_bad(std::move(reason));
}

std::optional<CarmenRecord> CarmenReader::take(std::string_view line) {
  while (!line.empty() && (line.back() == '\n' || line.back() == '\r')) {
    line.remove_suffix(1);
  }
  auto record = parse_carmen_line(line);
  if (!record) {
    count_bad(record.error().message);
    return std::nullopt;
  }
  if (!*record) {
    ++summary_.ignored;
    return std::nullopt;
  }
  last_was_scan_ = std::holds_alternative<CarmenScan>(**record);
  ++(last_was_scan_ ? summary_.scans : summary_.odometry);
  return std::move(*record);
}

std::optional<CarmenRecord> CarmenReader::next() {
  std::string line;
  while (true) {
    const File::Line read = file_->read_line(line);
    if (read == File::Line::kEnd) {
      summary_.damage = file_->damage();
      return std::nullopt;
    }
    ++summary_.lines;
    if (read == File::Line::kTooLong) {
      count_bad("the line is longer than " + std::to_string(kMaxLine_bytes) + " bytes");
    } else if (auto record = take(line)) {
      return record;
    }
  }
}

std::string describe(const ReplaySummary& summary) {
  std::string text = "read " + std::to_string(summary.lines) + " lines: " + std::to_string(summary.scans) + " scans, " +
                     std::to_string(summary.odometry) + " odometry records over " +
                     std::to_string(static_cast<int>(summary.duration_s)) + " s, " + std::to_string(summary.ignored) +
                     " ignored, " + std::to_string(summary.bad) + " bad";
  if (!summary.examples.empty()) {
    text += " (first: line " + std::to_string(summary.examples.front().number) + ", " +
            summary.examples.front().reason + ")";
  }
  if (summary.overtaken > 0) {
    text += "; " + std::to_string(summary.overtaken) + " scans were overtaken by newer ones";
  }
  if (!summary.damage.empty()) {
    text += "; the file ends early: " + summary.damage;
  }
  return text;
}

}  // namespace seeker::drivers
