#include "server/emulator/line_noise.hpp"

namespace seeker::emulator {

std::vector<std::uint8_t> LineNoise::carry(std::span<const std::uint8_t> bytes, const LineFaults& faults) {
  constexpr unsigned kBits = 8;
  std::vector<std::uint8_t> arrived;
  if (faults.silent) {
    return arrived;
  }
  arrived.reserve(bytes.size());
  for (std::uint8_t byte : bytes) {
    if (faults.lost_byte_rate > 0.0 && rng_.uniform() < faults.lost_byte_rate) {
      continue;
    }
    for (unsigned bit = 0; faults.bit_error_rate > 0.0 && bit < kBits; ++bit) {
      if (rng_.uniform() < faults.bit_error_rate) {
        byte = static_cast<std::uint8_t>(byte ^ (1U << bit));
      }
    }
    arrived.push_back(faults.wrong_baud ? static_cast<std::uint8_t>(rng_.bits()) : byte);
  }
  return arrived;
}

}  // namespace seeker::emulator
