/// \file
/// The packet that Pioneer bases and their clients send each other (protocols 1.2): 0xFA 0xFB, the count of bytes that
/// follow, a number that says what the packet is, its data, and a checksum with the high byte first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace seeker::p2os {

inline constexpr std::uint8_t kHeader0 = 0xFA;
inline constexpr std::uint8_t kHeader1 = 0xFB;
/// Bytes before the counted ones: the header and the count itself.
inline constexpr std::size_t kPrefixBytes = 3;
inline constexpr std::size_t kChecksumBytes = 2;
/// Smallest count of bytes: a number and the checksum.
inline constexpr std::size_t kMinCount = 1 + kChecksumBytes;
/// Largest whole packet; receivers refuse a count above it, so that a damaged count holds up little of the stream.
inline constexpr std::size_t kMaxPacketBytes = 200;
inline constexpr std::size_t kMaxCount = kMaxPacketBytes - kPrefixBytes;
inline constexpr std::size_t kMaxDataBytes = kMaxCount - kMinCount;

/// Numbers of the packets that a base sends; the answers to a handshake carry the numbers of its commands.
enum class PacketId : std::uint8_t {
  kSync0 = 0x00,
  kSync1 = 0x01,
  kSync2 = 0x02,
  kConfig = 0x20,
  kSipStopped = 0x32,
  kSipMoving = 0x33,
  kEncoder = 0x90,
  kGyro = 0x98,
  kSyncRefused = 0xFF,  ///< the base is in another step of the handshake
};

/// A packet without its frame.
struct Packet {
  std::uint8_t id = 0;  ///< a command of the client, or a PacketId
  std::vector<std::uint8_t> data;

  [[nodiscard]] bool is(PacketId wanted) const { return id == static_cast<std::uint8_t>(wanted); }
  friend bool operator==(const Packet&, const Packet&) = default;
};

/// Checksum over a packet's number and data: the sum of pairs as big-endian words, and an odd last byte by exclusive
/// or (protocols 1.2).
[[nodiscard]] std::uint16_t checksum(std::span<const std::uint8_t> counted);

/// The bytes of a packet with at most kMaxDataBytes of data.
[[nodiscard]] std::vector<std::uint8_t> encode(const Packet& packet);

}  // namespace seeker::p2os
