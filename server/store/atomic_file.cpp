#include "server/store/atomic_file.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace seeker::store {
namespace {

tl::unexpected<Error> system_failure(const std::string& what, const std::filesystem::path& path, int number) {
  const Errc code = number == ENOENT ? Errc::kNotFound : Errc::kIo;
  return fail(code, what + " '" + path.string() + "': " + std::strerror(number));
}

class FileDescriptor {
 public:
  explicit FileDescriptor(int fd) : fd_(fd) {}
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  ~FileDescriptor() {
    if (fd_ >= 0) {
      ::close(fd_);
    }
  }
  [[nodiscard]] int get() const { return fd_; }
  /// Some file systems tell of a failed write only here.
  [[nodiscard]] bool close() { return ::close(std::exchange(fd_, -1)) == 0; }

 private:
  int fd_;
};

bool write_all(int fd, std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) {
      continue;
    }
    if (n <= 0) {
      return false;
    }
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
  return true;
}

Status write_and_close(FileDescriptor& file, std::span<const std::uint8_t> bytes, const std::filesystem::path& path,
                       Outlives outlives) {
  constexpr mode_t kMode = 0644;
  const bool sync = outlives == Outlives::kPowerCut;
  if (!write_all(file.get(), bytes) || ::fchmod(file.get(), kMode) != 0 || (sync && ::fsync(file.get()) != 0) ||
      !file.close()) {
    return system_failure("cannot write", path, errno);
  }
  return {};
}

}  // namespace

Status write_file_atomically(const std::filesystem::path& path, std::span<const std::uint8_t> bytes,
                             Outlives outlives) {
  std::string temporary = path.string() + ".XXXXXX";
  FileDescriptor file(::mkostemp(temporary.data(), O_CLOEXEC));
  if (file.get() < 0) {
    return fail(Errc::kIo, "cannot create a file in the folder of '" + path.string() + "': " + std::strerror(errno));
  }
  Status ok = write_and_close(file, bytes, path, outlives);
  if (ok && ::rename(temporary.c_str(), path.c_str()) != 0) {
    ok = system_failure("cannot replace", path, errno);
  }
  if (!ok) {
    ::unlink(temporary.c_str());
    return ok;
  }
  return outlives == Outlives::kPowerCut ? sync_folder(path.parent_path()) : Status();
}

Status write_file_atomically(const std::filesystem::path& path, std::string_view text) {
  return write_file_atomically(path, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

Result<std::vector<std::uint8_t>> read_file(const std::filesystem::path& path, std::size_t limit_bytes) {
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) {
    return system_failure("cannot open", path, errno);
  }
  std::vector<std::uint8_t> bytes;
  constexpr std::size_t kChunk_bytes = 65536;
  for (;;) {
    const std::size_t before = bytes.size();
    bytes.resize(before + kChunk_bytes);
    const ssize_t n = ::read(file.get(), bytes.data() + before, kChunk_bytes);
    if (n < 0 && errno != EINTR) {
      return system_failure("cannot read", path, errno);
    }
    bytes.resize(before + static_cast<std::size_t>(n < 0 ? 0 : n));
    if (bytes.size() > limit_bytes) {
      return fail(Errc::kTooLarge,
                  "'" + path.string() + "' is longer than the limit of " + std::to_string(limit_bytes) + " bytes");
    }
    if (n == 0) {
      return bytes;
    }
  }
}

Status sync_folder(const std::filesystem::path& folder) {
  const std::filesystem::path place = folder.empty() ? std::filesystem::path(".") : folder;
  const FileDescriptor file(::open(place.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (file.get() < 0 || ::fsync(file.get()) != 0) {
    return system_failure("cannot sync the folder", place, errno);
  }
  return {};
}

}  // namespace seeker::store
