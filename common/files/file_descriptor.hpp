/// \file
/// A file descriptor that is closed in the end, and what both kinds of writers need. For the sources of this folder.
#pragma once

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <utility>

#include <unistd.h>

#include "common/core/result.hpp"

namespace seeker::files {

/// kIo: `what` as in "read", and what the system says.
[[nodiscard]] inline tl::unexpected<Error> cannot(const std::string& what, const std::filesystem::path& path,
                                                  int number, const std::string& remedy = "") {
  return fail(Errc::kIo, "cannot " + what + " " + path.string() + ": " + std::strerror(number) + remedy);
}

[[nodiscard]] inline tl::unexpected<Error> cannot_write(const std::filesystem::path& path, int number) {
  return cannot("write", path, number, "; check that the folder exists, is writable and has space");
}

class FileDescriptor {
 public:
  explicit FileDescriptor(int fd) : fd_(fd) {}
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  FileDescriptor(FileDescriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&&) = delete;
  ~FileDescriptor() {
    if (fd_ >= 0) {
      ::close(fd_);
    }
  }
  [[nodiscard]] int get() const { return fd_; }
  /// Some file systems report a failed write only here.
  [[nodiscard]] bool close() { return ::close(std::exchange(fd_, -1)) == 0; }

 private:
  int fd_;
};

/// Everything, over interrupted and short writes.
[[nodiscard]] inline bool write_all(int fd, std::span<const std::uint8_t> bytes) {
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

}  // namespace seeker::files
