/// \file
/// Compression with a known size on the other side: a small frame must not unfold into all memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "common/core/result.hpp"

namespace seeker::wire {

/// One zstd frame that states its content size.
[[nodiscard]] std::string compress(std::span<const std::uint8_t> bytes);

/// Unpacks into exactly `out`; kCorrupt when the frame is damaged or holds another number of bytes.
[[nodiscard]] Status decompress(const std::string& frame, std::span<std::uint8_t> out);

}  // namespace seeker::wire
