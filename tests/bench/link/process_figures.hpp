/// \file
/// What a process costs, as Linux counts it.
#pragma once

#include <sys/types.h>

#include <cstdint>

namespace seeker::link_bench {

struct ProcessFigures {
  double processor_s = 0.0;  ///< user and system time since its start
  double waited_s = 0.0;     ///< of all its threads that there are: ready to run while others had the processor
  double resident_kib = 0.0;
};

/// Of a process of this user; zeros where there is none.
[[nodiscard]] ProcessFigures figures_of(pid_t process);

/// Bytes that this process's open TCP connections to `port` have received: with TLS and HTTP/2, without TCP and IP.
[[nodiscard]] std::uint64_t bytes_received_from(std::uint16_t port);

}  // namespace seeker::link_bench
