// The packets of Pioneer bases: any bytes in any portions, and what each packet's data may hold. The first byte chooses
// the size of the portions.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/core/assert.hpp"
#include "server/protocols/p2os/command.hpp"
#include "server/protocols/p2os/config_packet.hpp"
#include "server/protocols/p2os/gyro_packet.hpp"
#include "server/protocols/p2os/identity.hpp"
#include "server/protocols/p2os/packet_reader.hpp"
#include "server/protocols/p2os/sip.hpp"

namespace {

using namespace seeker::p2os;  // NOLINT: a fuzz target is one file about one protocol

std::vector<Packet> read_all(std::span<const std::uint8_t> bytes, std::size_t portion) {
  PacketReader reader;
  std::vector<Packet> packets;
  std::size_t taken = 0;
  for (std::size_t at = 0; at < bytes.size(); at += portion) {
    reader.feed(bytes.subspan(at, std::min(portion, bytes.size() - at)));
    while (auto packet = reader.next()) {
      taken += encode(*packet).size();
      packets.push_back(std::move(*packet));
    }
    SEEKER_ASSERT(reader.pending_bytes() < kMaxPacketBytes);
  }
  SEEKER_ASSERT(taken + reader.skipped_bytes() + reader.pending_bytes() == bytes.size());
  return packets;
}

/// What is read and written is read again as the same value.
void check_content(const Packet& packet) {
  if (const auto command = parse_command(packet)) {
    SEEKER_ASSERT(*parse_command({packet.id, packet.data}) == *command);
    SEEKER_ASSERT(encode_command(*command).size() <= kMaxPacketBytes);
  }
  if (const auto identity = read_identity(packet)) {
    SEEKER_ASSERT(*read_identity(write_identity(*identity)) == *identity);
  }
  if (const auto config = read_config(packet)) {
    SEEKER_ASSERT(*read_config(write_config(*config)) == *config);
  }
  if (const auto readings = read_gyro(packet); readings && readings->size() <= kMaxGyroReadings) {
    SEEKER_ASSERT(*read_gyro(write_gyro(*readings)) == *readings);
  }
  const Packet as_sip{static_cast<std::uint8_t>(PacketId::kSipMoving), packet.data};
  if (const auto sip = read_sip(as_sip); sip && sip->sonars.size() <= kMaxSipSonars) {
    SEEKER_ASSERT(*read_sip(write_sip(*sip)) == *sip);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) {
    return 0;
  }
  const std::span bytes(data + 1, size - 1);
  const auto packets = read_all(bytes, std::size_t{data[0]} + 1);
  SEEKER_ASSERT(packets == read_all(bytes, std::max<std::size_t>(bytes.size(), 1)));
  for (const Packet& packet : packets) {
    check_content(packet);
  }
  return 0;
}
