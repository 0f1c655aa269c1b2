/// \file
/// Where the next record of a stream begins, in bytes of which some were lost or damaged.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "server/protocols/rplidar/legacy_sample.hpp"

namespace seeker::rplidar {

/// What to do with the front of a buffer: to skip `skip` bytes, and then to take one record if `record`.
struct StreamCut {
  std::size_t skip = 0;
  bool record = false;

  friend bool operator==(const StreamCut&, const StreamCut&) = default;
};

/// The most bytes that these functions want to see before they decide.
inline constexpr std::size_t kMaxStreamLook = 256;

/// For legacy samples. `last` is the sample taken before, if any: samples are known by their check bits and by their
/// angles, of which each continues the one before. A sample is taken once its
/// successors confirm it. Nothing: more
/// bytes are needed.
[[nodiscard]] std::optional<StreamCut> cut_legacy(std::span<const std::uint8_t> bytes,
                                                  const std::optional<LegacySample>& last);

/// For capsules. `aligned`: the bytes follow directly upon a capsule. A capsule is taken once its successor has begun:
/// of capsules that lost bytes one in 256 has a right checksum. Nothing: more bytes are needed.
[[nodiscard]] std::optional<StreamCut> cut_capsule(std::span<const std::uint8_t> bytes, bool aligned);

}  // namespace seeker::rplidar
