#include "server/protocols/rplidar/descriptor.hpp"

#include "common/core/assert.hpp"
#include "server/protocols/rplidar/little_endian.hpp"

namespace seeker::rplidar {
namespace {

constexpr unsigned kModeShift = 30;
constexpr std::uint32_t kStreamMode = 1;

}  // namespace

std::array<std::uint8_t, kDescriptorBytes> encode(const Descriptor& descriptor) {
  SEEKER_ASSERT(descriptor.length <= kMaxAnswerLength);
  const std::uint32_t word = descriptor.length | (descriptor.stream ? kStreamMode << kModeShift : 0U);
  return {kDescriptorStart1,
          kDescriptorStart2,
          static_cast<std::uint8_t>(word),
          static_cast<std::uint8_t>(word >> 8),
          static_cast<std::uint8_t>(word >> 16),
          static_cast<std::uint8_t>(word >> 24),
          static_cast<std::uint8_t>(descriptor.type)};
}

std::optional<Descriptor> decode_descriptor(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kDescriptorBytes || bytes[0] != kDescriptorStart1 || bytes[1] != kDescriptorStart2) {
    return std::nullopt;
  }
  const std::uint32_t word = read_u32(bytes, 2);
  if ((word >> kModeShift) > kStreamMode) {
    return std::nullopt;
  }
  return Descriptor{word & kMaxAnswerLength, (word >> kModeShift) == kStreamMode, static_cast<AnswerType>(bytes[6])};
}

}  // namespace seeker::rplidar
