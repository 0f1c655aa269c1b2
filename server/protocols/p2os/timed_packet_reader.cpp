#include "server/protocols/p2os/timed_packet_reader.hpp"

namespace seeker::p2os {
namespace {

constexpr Duration kQuietToSalvage = std::chrono::milliseconds(30);
constexpr Duration kQuietToAbandon = std::chrono::milliseconds(100);

}  // namespace

void TimedPacketReader::feed(std::span<const std::uint8_t> bytes, RobotTime now) {
  reader_.feed(bytes);
  last_byte_ = now;
  salvaged_ = false;
}

void TimedPacketReader::pass(RobotTime now) {
  if (reader_.pending_bytes() == 0) {
    return;
  }
  if (now - last_byte_ >= kQuietToAbandon) {
    reader_.abandon();
  } else if (!salvaged_ && now - last_byte_ >= kQuietToSalvage) {
    reader_.salvage();
    salvaged_ = true;
  }
}

RobotTime TimedPacketReader::wake() const {
  if (reader_.pending_bytes() == 0) {
    return RobotTime::max();
  }
  return last_byte_ + (salvaged_ ? kQuietToAbandon : kQuietToSalvage);
}

}  // namespace seeker::p2os
