#include "server/protocols/p2os/packet_reader.hpp"

namespace seeker::p2os {

void PacketReader::feed(std::span<const std::uint8_t> bytes) {
  buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(begin_));
  begin_ = 0;
  buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
}

std::size_t PacketReader::packet_bytes(std::size_t at) const { return kPrefixBytes + buffer_[at + 2]; }

PacketReader::Found PacketReader::look_at(std::size_t at) const {
  const std::size_t there = buffer_.size() - at;
  if (buffer_[at] != kHeader0 || (there > 1 && buffer_[at + 1] != kHeader1)) {
    return Found::kNoHeader;
  }
  if (there < kPrefixBytes) {
    return Found::kUnfinished;
  }
  const std::size_t count = buffer_[at + 2];
  if (count < kMinCount || count > kMaxCount) {
    return Found::kDamaged;
  }
  if (there < packet_bytes(at)) {
    return Found::kUnfinished;
  }
  const std::span counted(buffer_.data() + at + kPrefixBytes, count - kChecksumBytes);
  const std::size_t end = at + packet_bytes(at);
  const auto stated = static_cast<std::uint16_t>((buffer_[end - 2] << 8U) | buffer_[end - 1]);
  return stated == checksum(counted) ? Found::kPacket : Found::kDamaged;
}

void PacketReader::skip_to(std::size_t at) {
  skipped_bytes_ += at - begin_;
  begin_ = at;
}

std::optional<Packet> PacketReader::next() {
  std::size_t at = begin_;
  Found found = Found::kNoHeader;
  for (; at < buffer_.size(); ++at) {
    found = look_at(at);
    if (found == Found::kUnfinished || found == Found::kPacket) {
      break;
    }
    bad_packets_ += found == Found::kDamaged ? 1U : 0U;
  }
  skip_to(at);
  if (at == buffer_.size() || found != Found::kPacket) {
    return std::nullopt;
  }
  const auto first = buffer_.begin() + static_cast<std::ptrdiff_t>(at);
  const auto end = first + static_cast<std::ptrdiff_t>(packet_bytes(at));
  Packet packet{first[kPrefixBytes], {first + kPrefixBytes + 1, end - kChecksumBytes}};
  begin_ = static_cast<std::size_t>(end - buffer_.begin());
  ++packets_;
  return packet;
}

void PacketReader::salvage() {
  for (std::size_t inner = begin_ + 1; inner < buffer_.size(); ++inner) {
    if (look_at(inner) == Found::kPacket) {
      ++bad_packets_;
      skip_to(inner);
      return;
    }
  }
}

void PacketReader::abandon() {
  if (begin_ < buffer_.size()) {
    ++bad_packets_;
    skip_to(begin_ + 1);
  }
}

void PacketReader::clear() {
  buffer_.clear();
  begin_ = 0;
}

}  // namespace seeker::p2os
