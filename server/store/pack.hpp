/// \file
/// Blobs compressed with a checksum: a flipped bit on the disk is an error, not a wrong map.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/core/result.hpp"

namespace seeker::store {

/// A zstd frame with its content's size and checksum.
[[nodiscard]] Result<std::vector<std::uint8_t>> pack(std::span<const std::uint8_t> bytes);

/// kCorrupt: not a frame of pack(), cut or altered; kTooLarge: it would unpack to more than `limit_bytes`.
[[nodiscard]] Result<std::vector<std::uint8_t>> unpack(std::span<const std::uint8_t> frame, std::size_t limit_bytes);

}  // namespace seeker::store
