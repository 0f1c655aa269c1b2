#include "server/drivers/p2os/packet_line.hpp"

#include <utility>

namespace seeker::drivers {
namespace {

/// A base sends a packet in one go, so that a pause within one comes from the line. After the first time a good packet
/// inside an unfinished one shows that the count of that one was damaged; after the second the rest will not come
/// (protocols 1.2).
constexpr Duration kQuietToSalvage = std::chrono::milliseconds(30);
constexpr Duration kQuietToAbandon = std::chrono::milliseconds(100);

}  // namespace

void PacketLine::feed(std::span<const std::uint8_t> bytes, RobotTime now) {
  reader_.feed(bytes);
  bytes_in_ += bytes.size();
  last_byte_ = now;
  salvaged_ = false;
}

void PacketLine::pass(RobotTime now) {
  if (reader_.pending_bytes() == 0 || !last_byte_) {
    return;
  }
  if (now - *last_byte_ >= kQuietToAbandon) {
    reader_.abandon();
  } else if (!salvaged_ && now - *last_byte_ >= kQuietToSalvage) {
    reader_.salvage();
    salvaged_ = true;
  }
}

RobotTime PacketLine::wake() const {
  if (reader_.pending_bytes() == 0 || !last_byte_) {
    return RobotTime::max();
  }
  return *last_byte_ + (salvaged_ ? kQuietToAbandon : kQuietToSalvage);
}

void PacketLine::write(const std::vector<std::uint8_t>& bytes) {
  bytes_out_ += bytes.size();
  auto* last = actions_.empty() ? nullptr : std::get_if<WriteBytes>(&actions_.back());
  if (last == nullptr) {
    actions_.emplace_back(WriteBytes{bytes});
  } else {
    last->bytes.insert(last->bytes.end(), bytes.begin(), bytes.end());
  }
}

void PacketLine::set_baud(std::uint32_t baud) { actions_.emplace_back(SetBaud{baud}); }

void PacketLine::drop_input() {
  reader_.clear();
  actions_.emplace_back(DropInput{});
}

std::vector<LineAction> PacketLine::take_actions() { return std::exchange(actions_, {}); }

LinkStatistics PacketLine::statistics() const {
  LinkStatistics statistics;
  statistics.bytes_in = bytes_in_;
  statistics.bytes_out = bytes_out_;
  statistics.packets_in = reader_.packets() - bad_contents_;
  statistics.packets_bad = reader_.bad_packets() + bad_contents_;
  statistics.bytes_skipped = reader_.skipped_bytes();
  return statistics;
}

}  // namespace seeker::drivers
