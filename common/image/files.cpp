#include "common/image/files.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace seeker::image {
namespace {

namespace fs = std::filesystem;

std::string reason(int error) { return std::generic_category().message(error); }

tl::unexpected<Error> cannot_write(const fs::path& path, int error) {
  return fail(Errc::kIo, "cannot write " + path.string() + ": " + reason(error) +
                             "; check that the folder exists, is writable and has space");
}

/// Everything in one go, over interrupted and short writes.
bool write_all(int descriptor, std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(descriptor, bytes.data(), bytes.size());
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

}  // namespace

Result<std::vector<std::uint8_t>> read_file(const fs::path& path, std::size_t limit_bytes) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) {
    return fail(Errc::kNotFound, "there is no file " + path.string());
  }
  if (!fs::is_regular_file(status)) {
    return fail(Errc::kIo, path.string() + " is not a regular file");
  }
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) {
    return fail(Errc::kIo, "cannot read " + path.string() + ": " + reason(errno));
  }
  std::vector<std::uint8_t> bytes;
  constexpr std::size_t kChunk_bytes = 65536;
  for (;;) {
    const std::size_t size = bytes.size();
    bytes.resize(size + kChunk_bytes);
    const std::size_t n = std::fread(bytes.data() + size, 1, kChunk_bytes, file.get());
    bytes.resize(size + n);
    if (bytes.size() > limit_bytes) {
      return fail(Errc::kTooLarge, path.string() + " is larger than " + std::to_string(limit_bytes) + " bytes");
    }
    if (n < kChunk_bytes) {
      break;
    }
  }
  if (std::ferror(file.get()) != 0) {
    return fail(Errc::kIo, "cannot read " + path.string() + " to its end");
  }
  return bytes;
}

Status write_file(const fs::path& path, std::span<const std::uint8_t> bytes) {
  const fs::path temporary = path.string() + ".tmp" + std::to_string(::getpid());
  constexpr int kMode = 0644;
  const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, kMode);
  if (descriptor < 0) {
    return cannot_write(path, errno);
  }
  bool ok = write_all(descriptor, bytes) && ::fsync(descriptor) == 0;
  int error = errno;
  if (::close(descriptor) != 0 && ok) {
    ok = false;
    error = errno;
  }
  if (ok && ::rename(temporary.c_str(), path.c_str()) != 0) {
    ok = false;
    error = errno;
  }
  if (!ok) {
    ::unlink(temporary.c_str());
    return cannot_write(path, error);
  }
  return {};
}

Status write_file(const fs::path& path, std::string_view text) {
  return write_file(path, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

}  // namespace seeker::image
