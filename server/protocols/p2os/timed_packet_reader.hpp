/// \file
/// A packet reader that does not wait for the rest of a damaged packet on a line that fell quiet.
#pragma once

#include <optional>
#include <span>

#include "common/core/time.hpp"
#include "server/protocols/p2os/packet_reader.hpp"

namespace seeker::p2os {

/// A sender writes a packet in one go, so that a pause within one comes from the line. After a short one a good packet
/// inside the unfinished one shows that the count of that one was damaged; after a longer one the rest will not come
/// (protocols 1.2).
class TimedPacketReader {
 public:
  void feed(std::span<const std::uint8_t> bytes, RobotTime now);
  /// The next whole packet. Nothing: more bytes are needed.
  [[nodiscard]] std::optional<Packet> next() { return reader_.next(); }
  /// Looks into an unfinished packet when the line has been quiet for long enough; next() may deliver after it.
  void pass(RobotTime now);
  /// When pass() is wanted next; the farthest time: no packet is unfinished.
  [[nodiscard]] RobotTime wake() const;
  void clear() { reader_.clear(); }

  [[nodiscard]] const PacketReader& reader() const { return reader_; }

 private:
  PacketReader reader_;
  RobotTime last_byte_;
  bool salvaged_ = false;  ///< the unfinished packet was looked into already
};

}  // namespace seeker::p2os
