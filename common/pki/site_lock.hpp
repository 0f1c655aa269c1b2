/// \file
/// One program at a time changes a site.
#pragma once

#include <filesystem>

#include "common/core/result.hpp"

namespace seeker::pki {

/// Held while it lives; the system lets go when the program ends, however it ends.
class SiteLock {
 public:
  /// kBusy: another program has it; kIo.
  [[nodiscard]] static Result<SiteLock> take(const std::filesystem::path& folder);
  SiteLock(SiteLock&& other) noexcept;
  SiteLock& operator=(SiteLock&&) = delete;
  SiteLock(const SiteLock&) = delete;
  SiteLock& operator=(const SiteLock&) = delete;
  ~SiteLock();

 private:
  explicit SiteLock(int fd) : fd_(fd) {}

  int fd_;
};

}  // namespace seeker::pki
