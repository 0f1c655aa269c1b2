/// \file
/// The memory of a process, as Linux counts it.
#pragma once

#include <sys/types.h>

#include <fstream>
#include <optional>
#include <string>

namespace seeker::testing {

/// In kB, of the line `which` of /proc/PID/status: "VmRSS" (resident now) or "VmHWM" (the most so far). Nothing: there
/// is no such process or line.
[[nodiscard]] inline std::optional<long> memory_kb(pid_t process, const std::string& which) {
  std::ifstream in("/proc/" + std::to_string(process) + "/status");
  for (std::string word; in >> word;) {
    if (word == which + ":") {
      long kb = 0;
      in >> kb;
      return kb;
    }
  }
  return std::nullopt;
}

}  // namespace seeker::testing
