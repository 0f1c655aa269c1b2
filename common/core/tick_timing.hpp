/// \file
/// How well a loop that is paced by the wall clock keeps to it.
#pragma once

#include <cstdint>

#include "common/core/time.hpp"

namespace seeker {

/// Since the loop started. Time in which it rested on purpose does not count.
struct TickTiming {
  /// A tick that begins later than this after its time is late.
  static constexpr Duration kLate = std::chrono::milliseconds(20);

  std::uint64_t ticks = 0;
  std::uint64_t late = 0;
  Duration worst{};  ///< the most that a tick began after its time; wall time

  friend bool operator==(const TickTiming&, const TickTiming&) = default;
};

}  // namespace seeker
