#include "server/drivers/p2os/packet_line.hpp"

#include <utility>

namespace seeker::drivers {

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
  statistics.packets_in = reader_.reader().packets() - bad_contents_;
  statistics.packets_bad = reader_.reader().bad_packets() + bad_contents_;
  statistics.bytes_skipped = reader_.reader().skipped_bytes();
  return statistics;
}

}  // namespace seeker::drivers
