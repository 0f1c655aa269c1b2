#include <algorithm>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/core/rng.hpp"
#include "server/protocols/p2os/packet_reader.hpp"
#include "tests/unit/server/protocols/p2os/hex.hpp"

namespace seeker::p2os {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// A packet without the byte that begins a header, so that nothing inside it looks like a packet.
Packet random_packet(Rng& rng) {
  Packet packet{static_cast<std::uint8_t>(rng.below(kHeader0)), Bytes(rng.below(kMaxDataBytes + 1))};
  std::generate(packet.data.begin(), packet.data.end(), [&] { return static_cast<std::uint8_t>(rng.below(kHeader0)); });
  return packet;
}

std::vector<Packet> random_packets(Rng& rng, std::size_t count) {
  std::vector<Packet> packets(count);
  std::generate(packets.begin(), packets.end(), [&] { return random_packet(rng); });
  return packets;
}

void append(Bytes& stream, const Bytes& bytes) { stream.insert(stream.end(), bytes.begin(), bytes.end()); }

std::vector<Packet> read_in_pieces(PacketReader& reader, const Bytes& stream, Rng& rng) {
  std::vector<Packet> packets;
  for (std::size_t at = 0; at < stream.size();) {
    const std::size_t n = std::min<std::size_t>(1 + rng.below(40), stream.size() - at);
    reader.feed(std::span(stream).subspan(at, n));
    at += n;
    while (auto packet = reader.next()) {
      packets.push_back(std::move(*packet));
    }
  }
  return packets;
}

RC_GTEST_PROP(P2osPacketReader, AnyPacketsInAnyPiecesComeOutUnchangedAndInOrder, (std::uint64_t seed)) {
  Rng rng(seed);
  const auto packets = random_packets(rng, rng.below(20));
  Bytes stream;
  for (const Packet& packet : packets) {
    append(stream, encode(packet));
  }
  PacketReader reader;
  RC_ASSERT(read_in_pieces(reader, stream, rng) == packets);
  RC_ASSERT(reader.pending_bytes() == 0U);
  RC_ASSERT(reader.skipped_bytes() == 0U);
  RC_ASSERT(reader.packets() == packets.size());
}

RC_GTEST_PROP(P2osPacketReader, AnyStreamGivesTheSamePacketsHoweverItIsCut, (Bytes stream, std::uint64_t seed)) {
  Rng rng(seed);
  for (std::size_t k = 0; k < 4; ++k) {
    append(stream, encode(random_packet(rng)));
    append(stream, {kHeader0, kHeader1, static_cast<std::uint8_t>(rng.below(256))});
  }
  PacketReader whole;
  whole.feed(stream);
  std::vector<Packet> expected;
  while (auto packet = whole.next()) {
    expected.push_back(std::move(*packet));
  }
  PacketReader cut;
  RC_ASSERT(read_in_pieces(cut, stream, rng) == expected);
  RC_ASSERT(cut.skipped_bytes() == whole.skipped_bytes());
  RC_ASSERT(cut.bad_packets() == whole.bad_packets());
}

RC_GTEST_PROP(P2osPacketReader, AnyGarbageBetweenPacketsIsSkipped, (std::uint64_t seed)) {
  Rng rng(seed);
  const auto packets = random_packets(rng, 10);
  Bytes stream;
  std::size_t garbage = 0;
  for (const Packet& packet : packets) {
    // Bytes that begin no header, and often the first half of one.
    for (std::uint64_t n = rng.below(30); n > 0; --n, ++garbage) {
      stream.push_back(rng.below(4) == 0 ? kHeader0 : static_cast<std::uint8_t>(rng.below(kHeader0)));
    }
    append(stream, encode(packet));
  }
  PacketReader reader;
  RC_ASSERT(read_in_pieces(reader, stream, rng) == packets);
  RC_ASSERT(reader.skipped_bytes() == garbage);
}

RC_GTEST_PROP(P2osPacketReader, OfAStreamWithDamagedPacketsAllOthersAreDelivered, (std::uint64_t seed)) {
  Rng rng(seed);
  const auto packets = random_packets(rng, 300);
  std::vector<Packet> undamaged;
  Bytes stream;
  for (const Packet& packet : packets) {
    Bytes bytes = encode(packet);
    if (rng.below(100) == 0) {
      bytes[rng.below(bytes.size())] ^= static_cast<std::uint8_t>(1U << rng.below(8));
    } else {
      undamaged.push_back(packet);
    }
    append(stream, bytes);
  }
  // A damaged count of the last packet is known to be one only when more bytes have come.
  append(stream, Bytes(kMaxPacketBytes, 0));
  PacketReader reader;
  RC_ASSERT(read_in_pieces(reader, stream, rng) == undamaged);
}

TEST(P2osPacketReader, APacketInsideAPacketWithAWrongChecksumIsDelivered) {
  PacketReader reader;
  reader.feed(hex("FA FB 0A 32 01 FA FB 03 1D 00 1D 00 00"));
  EXPECT_EQ(reader.next(), (Packet{0x1D, {}}));
  EXPECT_EQ(reader.bad_packets(), 1U);
}

TEST(P2osPacketReader, ACountThatNoPacketHasIsRefusedAtOnce) {
  PacketReader reader;
  reader.feed(hex("FA FB 02 00 FA FB FF 00 FA FB C6 00 FA FB 03 1D 00 1D"));
  EXPECT_EQ(reader.next(), (Packet{0x1D, {}}));
  EXPECT_EQ(reader.bad_packets(), 3U);
}

TEST(P2osPacketReader, TheLargestPacketIsDelivered) {
  const Packet packet{0x20, Bytes(kMaxDataBytes, 7)};
  ASSERT_EQ(encode(packet).size(), kMaxPacketBytes);
  PacketReader reader;
  reader.feed(encode(packet));
  EXPECT_EQ(reader.next(), packet);
}

TEST(P2osPacketReader, AQuietLineGivesUpADamagedCountForTheGoodPacketInsideIt) {
  PacketReader reader;
  reader.feed(hex("FA FB 80 32 FA FB 90 FA FB 03 1D 00 1D"));
  EXPECT_FALSE(reader.next());
  reader.salvage();
  EXPECT_EQ(reader.next(), (Packet{0x1D, {}}));
  EXPECT_EQ(reader.bad_packets(), 1U);
}

TEST(P2osPacketReader, AQuietLineKeepsAnUnfinishedPacketWithoutAnotherInside) {
  const Bytes bytes = hex("FA FB 06 0B 3B FA 00 05 3B");
  PacketReader reader;
  reader.feed(std::span(bytes).first(5));
  EXPECT_FALSE(reader.next());
  reader.salvage();
  EXPECT_EQ(reader.pending_bytes(), 5U);
  reader.feed(std::span(bytes).subspan(5));
  EXPECT_TRUE(reader.next());
}

TEST(P2osPacketReader, AnAbandonedPacketLeavesWhatIsInsideIt) {
  PacketReader reader;
  reader.feed(hex("FA FB 80 32 FA FB 04"));
  EXPECT_FALSE(reader.next());
  reader.abandon();
  EXPECT_FALSE(reader.next());
  EXPECT_EQ(reader.pending_bytes(), 3U);
  reader.feed(hex("1D 05 1D 05"));
  EXPECT_EQ(reader.next(), (Packet{0x1D, {5}}));
}

TEST(P2osPacketReader, ClearingForgetsAnUnfinishedPacket) {
  PacketReader reader;
  reader.feed(hex("FA FB 80 32"));
  reader.clear();
  reader.feed(hex("FA FB 03 1D 00 1D"));
  EXPECT_EQ(reader.next(), (Packet{0x1D, {}}));
  EXPECT_EQ(reader.skipped_bytes(), 0U);
}

}  // namespace
}  // namespace seeker::p2os
