#include "common/pki/site_lock.hpp"

#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace seeker::pki {

Result<SiteLock> SiteLock::take(const std::filesystem::path& folder) {
  const int fd = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) {
    return fail(Errc::kIo, "cannot open the folder " + folder.string() + ": " + std::strerror(errno));
  }
  SiteLock lock(fd);
  if (::flock(fd, LOCK_EX | LOCK_NB) != 0) {
    return fail(Errc::kBusy, "another program changes the site " + folder.string() + "; try again when it has ended");
  }
  return lock;
}

SiteLock::SiteLock(SiteLock&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}

SiteLock::~SiteLock() {
  if (fd_ >= 0) {
    ::close(fd_);
  }
}

}  // namespace seeker::pki
