/// \file
/// What a bad link does to connections, as values.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "common/core/rng.hpp"
#include "common/core/time.hpp"

namespace seeker::testing {

/// How connections suffer; the default does nothing. TCP loses no bytes and keeps their order, so what a bad network
/// does to it is time, broken connections, and silence. Counts of bytes are of both ways together, from the moment the
/// impairment begins or, for a later connection, from its first byte.
struct Impairment {
  Duration delay{};        ///< each byte arrives this much later, either way
  Duration jitter{};       ///< and up to this much more, evenly spread; no byte overtakes another
  double bytes_per_s = 0;  ///< bandwidth of either way; 0: no limit
  std::size_t piece = 0;   ///< bytes are passed on at most so many at a time; 0: as they come
  bool stalled = false;    ///< nothing passes, the connections stay
  std::optional<std::size_t> stalled_alone = {};  ///< as stalled, the connection of this number (the first is 1) alone
  double drop = 0.0;                              ///< the share of new connections that are closed at once
  double reorder = 0.0;  ///< the share of new connections that are served when the next one was heard
  Duration hold = std::chrono::milliseconds(200);  ///< or after this, when no other one comes
  std::optional<std::size_t> cut_at = {};          ///< the connection breaks after so many bytes
  std::optional<std::size_t> half_open_at = {};  ///< after so many bytes one side is gone, and the other is never told
};

/// The kinds of impairment, each alone.
enum class Trouble : std::uint8_t { kDelay, kJitter, kDrop, kCut, kReorder, kHalfOpen, kPieces, kBandwidth, kStall };
inline constexpr std::array kTroubles{Trouble::kDelay,  Trouble::kJitter,    Trouble::kDrop,
                                      Trouble::kCut,    Trouble::kReorder,   Trouble::kHalfOpen,
                                      Trouble::kPieces, Trouble::kBandwidth, Trouble::kStall};
[[nodiscard]] std::string_view to_string(Trouble trouble);

/// One of a kind, as bad as the draw makes it: at most as a session of short heartbeats can survive or must notice.
[[nodiscard]] Impairment random_impairment(Trouble trouble, Rng& rng);

}  // namespace seeker::testing
