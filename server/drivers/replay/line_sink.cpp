#include "server/drivers/replay/line_sink.hpp"

#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include <zlib.h>

namespace seeker::drivers {
namespace {

constexpr int kMostRecordings = 10'000;  ///< of one name

/// FOLDER/drive.clf.gz as FOLDER/drive-2.clf.gz.
std::filesystem::path numbered(const std::filesystem::path& path, int number) {
  if (number == 1) {
    return path;
  }
  std::string name = path.filename().string();
  const std::size_t dot = name.find('.', 1);
  name.insert(dot == std::string::npos ? name.size() : dot, "-" + std::to_string(number));
  return path.parent_path() / name;
}

/// The first name that no file has. A device, such as /dev/full, is written to as it is.
std::filesystem::path free_name(const std::filesystem::path& path) {
  std::error_code error;
  for (int number = 1; number < kMostRecordings; ++number) {
    std::filesystem::path name = numbered(path, number);
    if (!std::filesystem::is_regular_file(name, error)) {
      return name;
    }
  }
  return numbered(path, kMostRecordings);
}

std::string cause_of(int error_number) { return error_number == 0 ? "unknown cause" : std::strerror(error_number); }

}  // namespace

struct LineSink::File {
  explicit File(gzFile opened) : handle(opened) {}
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File() { gzclose(handle); }

  gzFile handle;
};

Result<LineSink> LineSink::create(const std::filesystem::path& path) {
  const std::filesystem::path name = free_name(path);
  const bool device = std::filesystem::exists(name);
  const std::string mode = std::string(device ? "wb" : "wbx") + (name.extension() == ".gz" ? "" : "T");
  errno = 0;
  gzFile file = gzopen(name.c_str(), mode.c_str());
  if (file == nullptr) {
    return fail(Errc::kIo, name.string() + " cannot be created: " + cause_of(errno) +
                               "; check that its folder is there and may be written to");
  }
  return LineSink(std::make_unique<File>(file), name);
}

LineSink::LineSink(std::unique_ptr<File> file, std::filesystem::path path)
    : file_(std::move(file)), path_(std::move(path)) {}
LineSink::LineSink(LineSink&&) noexcept = default;
LineSink& LineSink::operator=(LineSink&&) noexcept = default;
LineSink::~LineSink() = default;

Status LineSink::write_and_flush(std::string_view text) {
  errno = 0;
  const bool written = text.empty() || gzwrite(file_->handle, text.data(), static_cast<unsigned>(text.size())) > 0;
  if (!written || gzflush(file_->handle, Z_SYNC_FLUSH) != Z_OK) {
    return fail(Errc::kIo, path_.string() + " cannot be written: " + cause_of(errno) +
                               "; free space on its disk, then restart the program to record again");
  }
  return {};
}

}  // namespace seeker::drivers
