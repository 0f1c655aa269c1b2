/// \file
/// The line to a base as packets: what arrives is cut into packets, what is to be sent is collected in order.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/core/time.hpp"
#include "server/drivers/link/device_session.hpp"
#include "server/protocols/p2os/timed_packet_reader.hpp"

namespace seeker::drivers {

/// Both directions of one line, with their statistics over all connections.
class PacketLine {
 public:
  void feed(std::span<const std::uint8_t> bytes, RobotTime now) {
    bytes_in_ += bytes.size();
    reader_.feed(bytes, now);
  }
  /// The next whole packet. Nothing: more bytes are needed.
  [[nodiscard]] std::optional<p2os::Packet> next() { return reader_.next(); }
  /// Looks into an unfinished packet when the line has been quiet for a while; next() may deliver after it.
  void pass(RobotTime now) { reader_.pass(now); }
  /// When pass() is wanted next; the farthest time: no packet is unfinished.
  [[nodiscard]] RobotTime wake() const { return reader_.wake(); }

  void write(const std::vector<std::uint8_t>& bytes);
  void set_baud(std::uint32_t baud);
  /// Forgets all that was received and not delivered.
  void drop_input();
  [[nodiscard]] std::vector<LineAction> take_actions();

  /// Counts a packet whose content was refused.
  void count_bad_content() { ++bad_contents_; }
  /// All but the connects, which the session counts.
  [[nodiscard]] LinkStatistics statistics() const;

 private:
  p2os::TimedPacketReader reader_;
  std::vector<LineAction> actions_;
  std::uint64_t bytes_in_ = 0;
  std::uint64_t bytes_out_ = 0;
  std::uint64_t bad_contents_ = 0;
};

}  // namespace seeker::drivers
