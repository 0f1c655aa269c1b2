/// \file
/// Durations that several threads measure.
#pragma once

#include <filesystem>
#include <mutex>
#include <vector>

#include "common/core/result.hpp"
#include "common/core/time.hpp"

namespace seeker::link_bench {

/// The clock that all processes of this machine share, as robot time.
[[nodiscard]] RobotTime now();

/// May be used from any thread.
class Latencies {
 public:
  void add(Duration latency);
  /// Writes the durations in microseconds, one a line in the order in which they came. kIo.
  [[nodiscard]] Status write(const std::filesystem::path& file) const;

 private:
  mutable std::mutex mutex_;
  std::vector<Duration> all_;
};

}  // namespace seeker::link_bench
