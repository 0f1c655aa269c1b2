/// \file
/// Checkpoints come back from the disk: whatever lies there is refused or unpacked within the limit, and what was
/// packed comes back as it was.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/core/assert.hpp"
#include "server/store/pack.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kLimit_bytes = std::size_t{1} << 20U;
  const std::span<const std::uint8_t> input(data, size);
  if (const auto bytes = seeker::store::unpack(input, kLimit_bytes)) {
    SEEKER_ASSERT(bytes->size() <= kLimit_bytes);
  }
  const auto frame = seeker::store::pack(input);
  SEEKER_ASSERT(frame.has_value());
  const auto back = seeker::store::unpack(*frame, size);
  SEEKER_ASSERT(back.has_value() && std::equal(back->begin(), back->end(), input.begin(), input.end()));
  return 0;
}
