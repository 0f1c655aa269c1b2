/// \file
/// Lateness of a loop that is paced by the wall clock.
#pragma once

#include <cstdint>

#include "common/core/time.hpp"

namespace seeker {

/// Counts of ticks since the loop started. Time in which the loop rests on purpose does not count.
struct TickTiming {
  /// A tick that begins later than this after its due time is late.
  static constexpr Duration kLate = std::chrono::milliseconds(20);

  std::uint64_t ticks = 0;
  std::uint64_t late = 0;
  Duration worst{};  ///< largest delay between the due time of a tick and its beginning; wall time

  friend bool operator==(const TickTiming&, const TickTiming&) = default;
};

}  // namespace seeker
