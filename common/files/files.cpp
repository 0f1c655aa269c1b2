#include "common/files/files.hpp"

#include <cerrno>
#include <cstdlib>
#include <string>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "common/files/file_descriptor.hpp"

namespace seeker::files {
namespace {

bool write_and_close(FileDescriptor& file, std::span<const std::uint8_t> bytes, bool sync, ReadableBy readers) {
  constexpr mode_t kForAll = 0644;
  constexpr mode_t kForOwner = 0600;
  const mode_t mode = readers == ReadableBy::kOwner ? kForOwner : kForAll;
  return write_all(file.get(), bytes) && ::fchmod(file.get(), mode) == 0 && (!sync || ::fsync(file.get()) == 0) &&
         file.close();
}

}  // namespace

Result<std::vector<std::uint8_t>> read_file(const std::filesystem::path& path, std::size_t limit_bytes) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    return fail(Errc::kNotFound, "there is no file " + path.string());
  }
  if (!std::filesystem::is_regular_file(status)) {
    return fail(Errc::kIo, path.string() + " is not a regular file");
  }
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) {
    return cannot("read", path, errno);
  }
  std::vector<std::uint8_t> bytes;
  constexpr std::size_t kChunk_bytes = 65536;
  for (;;) {
    const std::size_t before = bytes.size();
    bytes.resize(before + kChunk_bytes);
    const ssize_t n = ::read(file.get(), bytes.data() + before, kChunk_bytes);
    if (n < 0 && errno != EINTR) {
      return cannot("read", path, errno);
    }
    bytes.resize(before + static_cast<std::size_t>(n < 0 ? 0 : n));
    if (bytes.size() > limit_bytes) {
      return fail(Errc::kTooLarge, path.string() + " is larger than " + std::to_string(limit_bytes) + " bytes");
    }
    if (n == 0) {
      return bytes;
    }
  }
}

Status write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes, Outlives outlives,
                  ReadableBy readers) {
  const bool sync = outlives == Outlives::kPowerCut;
  std::string temporary = path.string() + ".XXXXXX";
  FileDescriptor file(::mkostemp(temporary.data(), O_CLOEXEC));
  if (file.get() < 0) {
    return cannot_write(path, errno);
  }
  if (!write_and_close(file, bytes, sync, readers) || ::rename(temporary.c_str(), path.c_str()) != 0) {
    const int number = errno;
    ::unlink(temporary.c_str());
    return cannot_write(path, number);
  }
  return sync ? sync_folder(path.parent_path()) : Status();
}

Status write_file(const std::filesystem::path& path, std::string_view text, ReadableBy readers) {
  return write_file(path, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()),
                    Outlives::kPowerCut, readers);
}

Status sync_folder(const std::filesystem::path& folder) {
  const std::filesystem::path place = folder.empty() ? std::filesystem::path(".") : folder;
  const FileDescriptor file(::open(place.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (file.get() < 0 || ::fsync(file.get()) != 0) {
    return cannot("sync the folder", place, errno);
  }
  return {};
}

}  // namespace seeker::files
