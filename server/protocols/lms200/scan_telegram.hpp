/// \file
/// A scan of the LMS200 as it travels (protocols 2.7).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/core/result.hpp"
#include "server/protocols/lms200/commands.hpp"
#include "server/protocols/lms200/measuring.hpp"

namespace seeker::lms200 {

/// Content of a response 0xB0 (all values) or 0xB7 (a sub-range).
struct ScanTelegram {
  /// The count has ten bits; no variant of the device has more values than 401.
  static constexpr std::size_t kMaxValues = 401;
  static constexpr std::uint8_t kMaxPartial = 3;

  Unit unit = Unit::kCentimetre;
  /// Set where the values are those of one rotation of the mirror: which fraction of a degree they lie at.
  std::optional<std::uint8_t> partial;
  std::optional<SubRange> sub_range;            ///< of a response 0xB7
  std::vector<std::uint16_t> words;             ///< value and flags; rightmost beam first, counter-clockwise
  std::optional<std::uint8_t> real_time_index;  ///< counts rotations of the mirror
  std::optional<std::uint8_t> telegram_index;   ///< counts telegrams

  friend bool operator==(const ScanTelegram&, const ScanTelegram&) = default;
};

/// The payload from the response byte to the status byte, which is given. At most kMaxValues words.
[[nodiscard]] std::vector<std::uint8_t> encode(const ScanTelegram& scan, std::uint8_t status);
/// Reads the payload of a response 0xB0 or 0xB7. One byte behind the values is the real-time index with
/// `real_time_index` (ConfigBlock::real_time_index), otherwise the telegram index; of two the real-time index is first.
/// kParse: lengths, unit or sub-range contradict each other.
[[nodiscard]] Result<ScanTelegram> decode_scan(std::span<const std::uint8_t> payload, bool real_time_index);

}  // namespace seeker::lms200
