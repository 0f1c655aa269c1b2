/// \file
/// Compression of blobs with a checksum, so that a flipped bit on the disk is an error and not a wrong map.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/core/result.hpp"

namespace seeker::store {

/// Compresses into a zstd frame that holds the size and the checksum of its content.
[[nodiscard]] Result<std::vector<std::uint8_t>> pack(std::span<const std::uint8_t> bytes);

/// Unpacks a frame of pack(). kCorrupt: no such frame, cut or altered; kTooLarge: it would unpack to more than
/// `limit_bytes`.
[[nodiscard]] Result<std::vector<std::uint8_t>> unpack(std::span<const std::uint8_t> frame, std::size_t limit_bytes);

}  // namespace seeker::store
