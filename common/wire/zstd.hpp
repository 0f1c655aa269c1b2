/// \file
/// Compression with a size that the receiver knows, so that a small frame cannot expand into all memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "common/core/result.hpp"

namespace seeker::wire {

/// Compresses into one zstd frame that states the size of its content.
[[nodiscard]] std::string compress(std::span<const std::uint8_t> bytes);

/// Unpacks into exactly `out`; kCorrupt when the frame is damaged or holds another number of bytes.
[[nodiscard]] Status decompress(const std::string& frame, std::span<std::uint8_t> out);

}  // namespace seeker::wire
