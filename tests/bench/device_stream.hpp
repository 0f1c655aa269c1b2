/// \file
/// What a device sends, for benchmarks of its codec, and the throughput of a codec beside the rate of its line.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <benchmark/benchmark.h>

#include "common/core/rng.hpp"

namespace seeker::bench {

using Bytes = std::vector<std::uint8_t>;

/// Goal of every codec: so many times what its fastest line carries, on one core.
inline constexpr double kGoalTimesLine = 1000.0;
/// Goal for bytes that cost a reader most, such as headers without packets: it keeps up with the line.
inline constexpr double kGoalTimesLineAtWorst = 1.0;
/// Portions in which a line hands its bytes over: a whole buffer, what one USB packet of a converter carries, one byte.
inline constexpr std::int64_t kBufferBytes = 4096;
inline constexpr std::int64_t kUsbPacketBytes = 62;
inline constexpr std::int64_t kSingleByte = 1;
/// Part of the bits that are wrong in a damaged stream: every second scan of an LMS200 has one.
inline constexpr double kBitErrorRate = 1e-4;

/// The stream with bit errors at kBitErrorRate, of a fixed seed.
inline Bytes damaged(Bytes bytes) {
  constexpr std::size_t kBits = 8;
  Rng rng(1);
  for (std::uint8_t& byte : bytes) {
    for (std::size_t bit = 0; bit < kBits; ++bit) {
      byte = static_cast<std::uint8_t>(rng.uniform() < kBitErrorRate ? byte ^ (1U << bit) : byte);
    }
  }
  return bytes;
}

/// The same bytes over and over.
inline Bytes repeated(const Bytes& bytes, std::size_t times) {
  Bytes all;
  all.reserve(times * bytes.size());
  for (std::size_t k = 0; k < times; ++k) {
    all.insert(all.end(), bytes.begin(), bytes.end());
  }
  return all;
}

/// Calls `take` with one portion of the stream after the other.
template <class Take>
void for_each_portion(const Bytes& stream, std::int64_t portion_bytes, Take take) {
  for (std::span<const std::uint8_t> rest = stream; !rest.empty();) {
    const std::size_t size = std::min(static_cast<std::size_t>(portion_bytes), rest.size());
    take(rest.first(size));
    rest = rest.subspan(size);
  }
}

/// Reports bytes per second of processor time, and how many times that is what a line of `baud` bits per second
/// carries. Each iteration has decoded `bytes_each`.
inline void report_throughput(benchmark::State& state, std::size_t bytes_each, double baud,
                              double goal = kGoalTimesLine) {
  constexpr double kBitsPerByte = 10.0;  // start bit, eight data bits, stop bit
  const auto bytes = static_cast<std::int64_t>(static_cast<std::size_t>(state.iterations()) * bytes_each);
  state.SetBytesProcessed(bytes);
  state.counters["times_line"] =
      benchmark::Counter(static_cast<double>(bytes) * kBitsPerByte / baud, benchmark::Counter::kIsRate);
  state.counters["goal"] = goal;
}

}  // namespace seeker::bench
