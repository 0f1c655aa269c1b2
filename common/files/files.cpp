#include "common/files/files.hpp"

#include <cerrno>
#include <cstdlib>
#include <string>

#include <fcntl.h>
#include <unistd.h>

#include "common/files/file_descriptor.hpp"
#include "common/files/file_error.hpp"
#include "common/files/temporary_file.hpp"

namespace seeker::files {
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
  Result<TemporaryFile> file = TemporaryFile::beside(path, readers);
  if (!file) {
    return tl::unexpected<Error>(file.error());
  }
  const int fd = file->descriptor();
  if (!write_all(fd, bytes) || (sync && ::fsync(fd) != 0)) {
    return cannot_write(path, errno);
  }
  if (const Status moved = file->move_to(path); !moved) {
    return moved;
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

Status make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  if (folder.empty() || std::filesystem::is_directory(folder, error)) {
    return {};
  }
  if (const Status above = make_folder(folder.parent_path()); !above) {
    return above;
  }
  if (std::filesystem::create_directory(folder, error)) {
    return sync_folder(folder.parent_path());
  }
  // Made by somebody else meanwhile is as good.
  if (std::filesystem::is_directory(folder)) {
    return {};
  }
  return fail(Errc::kIo, "cannot make the folder " + folder.string() + ": " +
                             (error ? error.message() : "a file of that name exists already"));
}

}  // namespace seeker::files
