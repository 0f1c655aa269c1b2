#include "server/drivers/replay/line_file.hpp"

#include <array>
#include <string_view>
#include <utility>

#include <zlib.h>

namespace seeker::drivers {

void BadLines::add(std::uint64_t number, std::string reason) {
  ++count;
  if (examples.size() < kMaxExamples) {
    examples.push_back({number, std::move(reason)});
  }
}

/// A gzFile, which reads plain files as well.
struct LineFile::File {
  explicit File(gzFile opened) : handle(opened) {}
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File() { gzclose(handle); }

  gzFile handle;
  std::array<char, 16384> buffer{};
};

Result<LineFile> LineFile::open(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    return fail(Errc::kNotFound, "there is no file " + path.string());
  }
  gzFile file = gzopen(path.c_str(), "rb");
  if (file == nullptr) {
    return fail(Errc::kIo, path.string() + " cannot be opened; check its permissions");
  }
  LineFile lines(std::make_unique<File>(file));
  if (lines.skip_byte_order_mark()) {
    return lines;
  }
  return fail(Errc::kParse, path.string() + " is text in UTF-16, of which nothing can be read; save it as UTF-8");
}

bool LineFile::skip_byte_order_mark() {
  std::array<unsigned char, 3> head{};
  const int read = gzread(file_->handle, head.data(), head.size());
  if (read == 3 && head == std::array<unsigned char, 3>{0xEF, 0xBB, 0xBF}) {
    return true;
  }
  const bool wide = read >= 2 && ((head[0] == 0xFF && head[1] == 0xFE) || (head[0] == 0xFE && head[1] == 0xFF));
  gzrewind(file_->handle);
  return !wide;
}

LineFile::LineFile(std::unique_ptr<File> file) : file_(std::move(file)) {}
LineFile::LineFile(LineFile&&) noexcept = default;
LineFile& LineFile::operator=(LineFile&&) noexcept = default;
LineFile::~LineFile() = default;

LineFile::Line LineFile::read(std::string& line) {
  line.clear();
  bool too_long = false;
  while (true) {
    std::array<char, 16384>& buffer = file_->buffer;
    if (gzgets(file_->handle, buffer.data(), static_cast<int>(buffer.size())) == nullptr) {
      return line.empty() && !too_long ? Line::kEnd : (too_long ? Line::kTooLong : Line::kGood);
    }
    // A zero byte ends the text early; what follows it in the buffer is lost, and the line is malformed.
    const std::string_view piece(buffer.data());
    too_long = too_long || line.size() + piece.size() > kMaxLine_bytes;
    if (!too_long) {
      line += piece;
    }
    if (piece.empty() || piece.back() == '\n') {
      return too_long ? Line::kTooLong : Line::kGood;
    }
  }
}

LineFile::Line LineFile::next(std::string& line) {
  const Line kind = read(line);
  number_ += kind == Line::kEnd ? 0 : 1;
  while (!line.empty() && (line.back() == '\n' || line.back() == '\r')) {
    line.pop_back();
  }
  return kind;
}

std::string LineFile::damage() const {
  int code = Z_OK;
  const char* text = gzerror(file_->handle, &code);
  return code == Z_OK || code == Z_STREAM_END ? std::string() : std::string(text);
}

}  // namespace seeker::drivers
