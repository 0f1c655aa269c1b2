#include "server/protocols/rplidar/legacy_sample.hpp"

#include "common/core/angle.hpp"
#include "common/core/assert.hpp"
#include "server/protocols/rplidar/little_endian.hpp"

namespace seeker::rplidar {
namespace {

constexpr float kMetresPerQ2 = 0.00025F;

}  // namespace

std::array<std::uint8_t, kLegacyBytes> encode(const LegacySample& sample) {
  SEEKER_ASSERT(sample.quality <= kMaxLegacyQuality && sample.angle_q6 <= kMaxAngleQ6);
  const unsigned turn_bits = sample.begins_revolution ? 0b01U : 0b10U;
  return {static_cast<std::uint8_t>((unsigned{sample.quality} << 2U) | turn_bits),
          static_cast<std::uint8_t>(((sample.angle_q6 & 0x7FU) << 1U) | 1U),
          static_cast<std::uint8_t>(sample.angle_q6 >> 7U), static_cast<std::uint8_t>(sample.distance_q2 & 0xFFU),
          static_cast<std::uint8_t>(sample.distance_q2 >> 8U)};
}

std::optional<LegacySample> decode_legacy(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kLegacyBytes) {
    return std::nullopt;
  }
  const bool turn = (bytes[0] & 1U) != 0;
  const bool not_turn = (bytes[0] & 2U) != 0;
  if (turn == not_turn || (bytes[1] & 1U) == 0) {
    return std::nullopt;
  }
  return LegacySample{turn, static_cast<std::uint8_t>(bytes[0] >> 2U),
                      static_cast<std::uint16_t>(read_u16(bytes, 1) >> 1U), read_u16(bytes, 3)};
}

PolarSample to_polar(const LegacySample& sample) {
  const double angle_rad = deg_to_rad(kDegPerQ6 * (sample.angle_q6 % kRevolutionQ6));
  if (sample.distance_q2 == 0) {
    return {angle_rad, kNoReturn, 0};
  }
  return {angle_rad, kMetresPerQ2 * static_cast<float>(sample.distance_q2), sample.quality};
}

}  // namespace seeker::rplidar
