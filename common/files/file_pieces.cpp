#include "common/files/file_pieces.hpp"

#include <cerrno>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "common/files/file_error.hpp"
#include "common/files/files.hpp"

namespace seeker::files {

namespace fs = std::filesystem;

Result<FileReader> FileReader::open(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) {
    return fail(Errc::kNotFound, "there is no file " + path.string());
  }
  if (!fs::is_regular_file(status)) {
    return fail(Errc::kIo, path.string() + " is not a regular file");
  }
  FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) {
    return cannot("read", path, errno);
  }
  return FileReader(path, std::move(file));
}

Result<FileIdentity> FileReader::identity() const {
  constexpr std::int64_t kNsPerSecond = 1'000'000'000;
  struct stat about {};
  if (::fstat(file_.get(), &about) != 0) {
    return cannot("read", path_, errno);
  }
  return FileIdentity{about.st_dev, about.st_ino, static_cast<std::uint64_t>(about.st_size),
                      about.st_mtim.tv_sec * kNsPerSecond + about.st_mtim.tv_nsec};
}

Result<std::vector<std::uint8_t>> FileReader::read(std::uint64_t offset, std::size_t limit_bytes) const {
  std::vector<std::uint8_t> bytes(limit_bytes);
  std::size_t have = 0;
  while (have < limit_bytes) {
    const ssize_t n = ::pread(file_.get(), bytes.data() + have, limit_bytes - have, static_cast<off_t>(offset + have));
    if (n < 0 && errno == EINTR) {
      continue;
    }
    if (n < 0) {
      return cannot("read", path_, errno);
    }
    if (n == 0) {
      break;
    }
    have += static_cast<std::size_t>(n);
  }
  bytes.resize(have);
  return bytes;
}

Status write_piece(const fs::path& path, std::uint64_t offset, std::span<const std::uint8_t> bytes) {
  constexpr mode_t kForAll = 0644;
  const int create = offset == 0 ? O_CREAT : 0;
  FileDescriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC | create, kForAll));
  if (file.get() < 0) {
    return cannot_write(path, errno);
  }
  const auto at = static_cast<off_t>(offset);
  const bool placed = ::ftruncate(file.get(), at) == 0 && ::lseek(file.get(), at, SEEK_SET) == at;
  if (!placed || !write_all(file.get(), bytes)) {
    const int number = errno;
    // Where not even this succeeds, the bytes are behind the offset at which the next piece is written.
    static_cast<void>(::ftruncate(file.get(), at));
    return cannot_write(path, number);
  }
  return file.close() ? Status() : cannot_write(path, errno);
}

Status put_in_place(const fs::path& from, const fs::path& to) {
  FileDescriptor file(::open(from.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0 || ::fsync(file.get()) != 0 || ::rename(from.c_str(), to.c_str()) != 0) {
    return cannot_write(to, errno);
  }
  return sync_folder(to.parent_path());
}

}  // namespace seeker::files
