#include "server/protocols/rplidar/express_capsule.hpp"

#include <cmath>

#include "common/core/angle.hpp"
#include "common/core/assert.hpp"
#include "server/protocols/rplidar/little_endian.hpp"

namespace seeker::rplidar {
namespace {

constexpr std::uint8_t kSync1 = 0xA0;
constexpr std::uint8_t kSync2 = 0x50;
constexpr std::uint8_t kSyncMask = 0xF0;
constexpr std::uint16_t kFirstBit = 0x8000;
constexpr std::size_t kCheckedFrom = 2;
constexpr std::size_t kCabinsAt = 4;
constexpr std::size_t kCabinBytes = 5;
constexpr double kDegPerQ3 = 1.0 / 8.0;
constexpr float kMetresPerMillimetre = 0.001F;

std::uint8_t checksum(std::span<const std::uint8_t> capsule) {
  std::uint8_t sum = 0;
  for (const std::uint8_t byte : capsule.subspan(kCheckedFrom, kCapsuleBytes - kCheckedFrom)) {
    sum ^= byte;
  }
  return sum;
}

/// The word of a sample: its distance, with the two high bits of its compensation.
std::uint16_t word_of(const CapsuleSample& sample) {
  SEEKER_ASSERT(sample.distance_mm <= kMaxCapsuleDistance_mm && sample.compensation_q3 <= kMaxCompensationQ3);
  return static_cast<std::uint16_t>((sample.distance_mm << 2U) | (sample.compensation_q3 >> 4U));
}

CapsuleSample sample_of(std::uint16_t word, unsigned low_compensation) {
  return {static_cast<std::uint16_t>(word >> 2U), static_cast<std::uint8_t>(((word & 3U) << 4U) | low_compensation)};
}

}  // namespace

std::array<std::uint8_t, kCapsuleBytes> encode(const ExpressCapsule& capsule) {
  std::array<std::uint8_t, kCapsuleBytes> bytes{};
  const auto put = [&](std::size_t at, std::uint16_t word) {
    bytes[at] = static_cast<std::uint8_t>(word & 0xFFU);
    bytes[at + 1] = static_cast<std::uint8_t>(word >> 8U);
  };
  SEEKER_ASSERT(capsule.start_angle_q6 < kFirstBit);
  put(kCheckedFrom, static_cast<std::uint16_t>(capsule.start_angle_q6 | (capsule.first ? kFirstBit : 0U)));
  for (std::size_t k = 0; k < kCapsuleSamples; k += 2) {
    const std::size_t at = kCabinsAt + k / 2 * kCabinBytes;
    put(at, word_of(capsule.samples[k]));
    put(at + 2, word_of(capsule.samples[k + 1]));
    bytes[at + 4] = static_cast<std::uint8_t>((capsule.samples[k].compensation_q3 & 0x0FU) |
                                              ((capsule.samples[k + 1].compensation_q3 & 0x0FU) << 4U));
  }
  const std::uint8_t sum = checksum(bytes);
  bytes[0] = static_cast<std::uint8_t>(kSync1 | (sum & 0x0FU));
  bytes[1] = static_cast<std::uint8_t>(kSync2 | (sum >> 4U));
  return bytes;
}

bool may_begin_capsule(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= 2 && (bytes[0] & kSyncMask) == kSync1 && (bytes[1] & kSyncMask) == kSync2;
}

std::optional<ExpressCapsule> decode_capsule(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kCapsuleBytes || !may_begin_capsule(bytes)) {
    return std::nullopt;
  }
  if (checksum(bytes) != static_cast<std::uint8_t>((bytes[0] & 0x0FU) | ((bytes[1] & 0x0FU) << 4U))) {
    return std::nullopt;
  }
  ExpressCapsule capsule;
  const std::uint16_t start = read_u16(bytes, kCheckedFrom);
  capsule.first = (start & kFirstBit) != 0;
  capsule.start_angle_q6 = static_cast<std::uint16_t>(start & ~kFirstBit);
  for (std::size_t k = 0; k < kCapsuleSamples; k += 2) {
    const std::size_t at = kCabinsAt + k / 2 * kCabinBytes;
    capsule.samples[k] = sample_of(read_u16(bytes, at), bytes[at + 4] & 0x0FU);
    capsule.samples[k + 1] = sample_of(read_u16(bytes, at + 2), bytes[at + 4] >> 4U);
  }
  return capsule;
}

std::array<PolarSample, kCapsuleSamples> to_polar(const ExpressCapsule& capsule, int advance_q6) {
  std::array<PolarSample, kCapsuleSamples> samples;
  for (std::size_t k = 0; k < kCapsuleSamples; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(kCapsuleSamples);
    const double raw_deg = kDegPerQ6 * (capsule.start_angle_q6 + share * advance_q6);
    const double angle_rad = deg_to_rad(raw_deg - kDegPerQ3 * capsule.samples[k].compensation_q3);
    const double in_turn_rad = angle_rad - kTwoPi * std::floor(angle_rad / kTwoPi);
    samples[k].angle_cw_rad = in_turn_rad < kTwoPi ? in_turn_rad : 0.0;  // a tiny negative angle rounds up to a turn
    if (capsule.samples[k].distance_mm != 0) {
      samples[k].range_m = kMetresPerMillimetre * static_cast<float>(capsule.samples[k].distance_mm);
      samples[k].quality = kCapsuleQuality;
    }
  }
  return samples;
}

}  // namespace seeker::rplidar
