/// \file
/// Cuts a stream of bytes into packets and finds the next good one after garbage or damage.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "server/protocols/p2os/packet.hpp"

namespace seeker::p2os {

/// Delivers every undamaged packet of a stream, in order, however the stream is cut. A packet with a wrong checksum or
/// count gives up its first byte only: what lies inside it is searched again, so that a damaged count never costs the
/// packets after it. Memory is bounded by one portion of the stream and one packet.
class PacketReader {
 public:
  /// Takes received bytes, in any portions.
  void feed(std::span<const std::uint8_t> bytes);
  /// The next packet. Nothing: more bytes are needed.
  [[nodiscard]] std::optional<Packet> next();

  /// For a line that fell quiet after next() delivered nothing: if a whole good packet lies inside the unfinished one,
  /// then its count was damaged, and next() delivers the inner one. An unfinished packet without one is kept.
  void salvage();
  /// Gives up an unfinished packet whose end will not come any more; next() searches what lies inside it.
  void abandon();
  /// Forgets all bytes that are not delivered yet, without counting them.
  void clear();

  [[nodiscard]] std::size_t pending_bytes() const { return buffer_.size() - begin_; }
  [[nodiscard]] std::uint64_t packets() const { return packets_; }
  /// Headers whose packet had a wrong checksum or an impossible count, or never ended.
  [[nodiscard]] std::uint64_t bad_packets() const { return bad_packets_; }
  /// Bytes that belonged to no good packet.
  [[nodiscard]] std::uint64_t skipped_bytes() const { return skipped_bytes_; }

 private:
  enum class Found : std::uint8_t { kNoHeader, kDamaged, kUnfinished, kPacket };

  /// What begins at this place of the buffer.
  [[nodiscard]] Found look_at(std::size_t at) const;
  [[nodiscard]] std::size_t packet_bytes(std::size_t at) const;
  void skip_to(std::size_t at);

  std::vector<std::uint8_t> buffer_;
  std::size_t begin_ = 0;  ///< of what is not delivered yet
  std::uint64_t packets_ = 0;
  std::uint64_t bad_packets_ = 0;
  std::uint64_t skipped_bytes_ = 0;
};

}  // namespace seeker::p2os
