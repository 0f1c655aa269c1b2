#include "server/protocols/lms200/crc.hpp"

namespace seeker::lms200 {

std::uint16_t crc16(std::span<const std::uint8_t> bytes) {
  constexpr std::uint32_t kGenerator = 0x8005;
  constexpr std::uint32_t kTopBit = 0x8000;
  std::uint32_t crc = 0;
  std::uint32_t previous = 0;
  for (const std::uint8_t byte : bytes) {
    crc = (crc & kTopBit) != 0 ? ((crc & ~kTopBit) << 1) ^ kGenerator : crc << 1;
    crc ^= byte | (previous << 8);
    previous = byte;
  }
  return static_cast<std::uint16_t>(crc);
}

}  // namespace seeker::lms200
