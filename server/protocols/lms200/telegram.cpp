#include "server/protocols/lms200/telegram.hpp"

#include <algorithm>

#include "common/core/assert.hpp"
#include "server/protocols/lms200/crc.hpp"
#include "server/protocols/lms200/little_endian.hpp"

namespace seeker::lms200 {

Duration transfer_time(std::size_t bytes, std::uint32_t baud) {
  SEEKER_ASSERT(baud > 0);
  return seconds(kBitsPerByte * static_cast<double>(bytes) / static_cast<double>(baud));
}

std::vector<std::uint8_t> encode_telegram(Sender sender, std::span<const std::uint8_t> payload) {
  SEEKER_ASSERT(!payload.empty() && payload.size() <= kMaxPayloadBytes);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(kHeaderBytes + payload.size() + kCrcBytes);
  bytes.push_back(kStx);
  bytes.push_back(sender == Sender::kHost ? kHostAddress : kDeviceAddress);
  append_u16(bytes, static_cast<std::uint16_t>(payload.size()));
  bytes.insert(bytes.end(), payload.begin(), payload.end());
  append_u16(bytes, crc16(bytes));
  return bytes;
}

StatusByte StatusByte::of(Level level, bool polluted) {
  return StatusByte(static_cast<std::uint8_t>(kGood | static_cast<unsigned>(level) | (polluted ? kPollutionBit : 0U)));
}

StatusByte::Level StatusByte::level() const {
  const auto level = static_cast<std::uint8_t>(raw_ & kLevelMask);
  return static_cast<Level>(std::min(level, static_cast<std::uint8_t>(Level::kFatal)));
}

}  // namespace seeker::lms200
