#include "server/protocols/p2os/packet.hpp"

#include "common/core/assert.hpp"

namespace seeker::p2os {

std::uint16_t checksum(std::span<const std::uint8_t> counted) {
  std::uint32_t sum = 0;
  std::size_t at = 0;
  for (; at + 1 < counted.size(); at += 2) {
    sum += static_cast<std::uint32_t>(counted[at] << 8U) | counted[at + 1];
  }
  sum &= 0xFFFFU;
  return static_cast<std::uint16_t>(at < counted.size() ? sum ^ counted[at] : sum);
}

std::vector<std::uint8_t> encode(const Packet& packet) {
  SEEKER_ASSERT(packet.data.size() <= kMaxDataBytes);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(kPrefixBytes + kMinCount + packet.data.size());
  bytes.push_back(kHeader0);
  bytes.push_back(kHeader1);
  bytes.push_back(static_cast<std::uint8_t>(kMinCount + packet.data.size()));
  bytes.push_back(packet.id);
  bytes.insert(bytes.end(), packet.data.begin(), packet.data.end());
  const std::uint16_t sum = checksum(std::span(bytes).subspan(kPrefixBytes));
  bytes.push_back(static_cast<std::uint8_t>(sum >> 8U));
  bytes.push_back(static_cast<std::uint8_t>(sum & 0xFFU));
  return bytes;
}

}  // namespace seeker::p2os
