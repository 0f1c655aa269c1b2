/// \file
/// What is known of the machine that the robot's program runs on.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "common/core/result.hpp"
#include "common/pki/certificate.hpp"
#include "server/app/state/journal.hpp"

namespace seeker::app {

/// Of the file system of the state folder.
struct DiskFacts {
  std::uint64_t free_bytes = 0;  ///< for programs without privileges
  std::uint64_t total_bytes = 0;
};

struct MemoryFacts {
  std::uint64_t available_bytes = 0;  ///< without swapping
  std::uint64_t total_bytes = 0;
  std::uint64_t own_bytes = 0;  ///< resident set of this program
};

struct ClockFacts {
  pki::CalendarTime now;
  std::optional<bool> synchronised;  ///< to a time server, as the kernel says; nothing: it does not say
};

struct HostFacts {
  std::string version;  ///< of this program
  std::filesystem::path folder;
  Result<DiskFacts> disk;
  Status writable;             ///< whether a file could be written into the folder
  Result<MemoryFacts> memory;  ///< kNotFound: the system does not say
  ClockFacts clock;
  std::optional<JournalHealth> journal;
  std::uint64_t audit_lost = 0;                              ///< records of who commanded what, since the start
  std::optional<Result<pki::CertificateFacts>> certificate;  ///< of the robot; nothing: plain TCP
};

/// Where to look. The functions are called by collect() and may be empty.
struct HostSources {
  std::string version;
  std::filesystem::path folder;       ///< of the robot's state
  std::filesystem::path certificate;  ///< empty: plain TCP
  std::function<JournalHealth()> journal;
  std::function<std::uint64_t()> audit_lost;
};

/// Looks at all of it; touches the disk.
[[nodiscard]] HostFacts collect(const HostSources& sources);

}  // namespace seeker::app
