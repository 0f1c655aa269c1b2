#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/protocols/p2os/command.hpp"
#include "server/protocols/p2os/identity.hpp"
#include "server/protocols/p2os/packet.hpp"
#include "server/protocols/p2os/packet_reader.hpp"
#include "tests/unit/server/protocols/p2os/hex.hpp"

namespace seeker::p2os {
namespace {

using Bytes = std::vector<std::uint8_t>;

TEST(P2osPacket, AVectorOfTheManualIsWrittenByteForByte) {
  EXPECT_EQ(encode_command(CommandId::kPulse), hex("FA FB 03 00 00 00"));
  EXPECT_EQ(encode_command(CommandId::kOpen), hex("FA FB 03 01 00 01"));
  EXPECT_EQ(encode_command(CommandId::kClose), hex("FA FB 03 02 00 02"));
  EXPECT_EQ(encode_command(CommandId::kOpen, 1), hex("FA FB 06 01 3B 01 00 02 3B"));
  EXPECT_EQ(encode_command(CommandId::kEnable, 1), hex("FA FB 06 04 3B 01 00 05 3B"));
  EXPECT_EQ(encode_command(CommandId::kVel, 250), hex("FA FB 06 0B 3B FA 00 05 3B"));
  EXPECT_EQ(encode_command(CommandId::kVel, -250), hex("FA FB 06 0B 1B FA 00 05 1B"));
  EXPECT_EQ(encode_command(CommandId::kRotVel, 10), hex("FA FB 06 15 3B 0A 00 1F 3B"));
  EXPECT_EQ(encode_command(CommandId::kRotVel, -10), hex("FA FB 06 15 1B 0A 00 1F 1B"));
  EXPECT_EQ(encode_command(CommandId::kSonar, 1), hex("FA FB 06 1C 3B 01 00 1D 3B"));
  EXPECT_EQ(encode_command(CommandId::kStop), hex("FA FB 03 1D 00 1D"));
  EXPECT_EQ(encode_command(CommandId::kEStop), hex("FA FB 03 37 00 37"));
  EXPECT_EQ(encode_command(CommandId::kConfig, 1), hex("FA FB 06 12 3B 01 00 13 3B"));
  EXPECT_EQ(encode_command(CommandId::kVel2, vel2_argument({5, 5})), hex("FA FB 06 20 3B 05 05 25 40"));
}

TEST(P2osPacket, AnIdentityIsWrittenByteForByte) {
  EXPECT_EQ(encode(write_identity({"Emu", "Pioneer", "p3dx-sh"})),
            hex("FA FB 17 02 45 6D 75 00 50 69 6F 6E 65 65 72 00 70 33 64 78 2D 73 68 00 CC B9"));
}

TEST(P2osPacket, AnIdentityWithoutItsThirdTextIsCorrupt) {
  Packet packet = write_identity({"Emu", "Pioneer", "p3dx-sh"});
  packet.data.pop_back();
  ASSERT_FALSE(read_identity(packet));
  EXPECT_EQ(read_identity(packet).error().code, Errc::kCorrupt);
}

TEST(P2osPacket, AVectorOfTheManualIsReadBack) {
  PacketReader reader;
  reader.feed(hex("FA FB 06 0B 1B FA 00 05 1B"));
  const auto packet = reader.next();
  ASSERT_TRUE(packet);
  const auto command = parse_command(*packet);
  ASSERT_TRUE(command);
  EXPECT_TRUE(command->is(CommandId::kVel));
  EXPECT_EQ(command->integer(), -250);
}

TEST(P2osPacket, TheOriginCommandOfPlayerIsACommandWithoutArgument) {
  PacketReader reader;
  reader.feed(hex("FA FB 04 07 3B 07 3B"));
  const auto packet = reader.next();
  ASSERT_TRUE(packet);
  EXPECT_EQ(*parse_command(*packet), (Command{static_cast<std::uint8_t>(CommandId::kSetOrigin), {}}));
}

TEST(P2osPacket, TheModemCommandOfAriaBeforeAPacketIsSkipped) {
  PacketReader reader;
  reader.feed(hex("57 4D 53 32 0D FA FB 03 00 00 00"));
  EXPECT_EQ(reader.next(), (Packet{0, {}}));
  EXPECT_EQ(reader.skipped_bytes(), 5U);
}

TEST(P2osCommand, AnUnknownTypeOfArgumentIsRefused) {
  EXPECT_EQ(parse_command({11, {0x77, 1, 0}}).error().code, Errc::kParse);
}

TEST(P2osCommand, ATextThatIsCutOffIsRefused) {
  EXPECT_EQ(parse_command({3, {0x2B, 3, 'a', 'b'}}).error().code, Errc::kParse);
  EXPECT_EQ(*parse_command({3, {0x2B}}), (Command{3, {}}));
}

TEST(P2osCommand, TheSpeedsOfTheWheelsAreTakenFromTheNegatedArgumentOfNegativeType) {
  // left -5, right 3: 0xFB03 as a signed word is -1277, which travels as 0x1B and 1277.
  EXPECT_EQ(vel2_argument({-5, 3}), -1277);
  EXPECT_EQ(vel2_speeds(-1277), (WheelSpeeds{-5, 3}));
  EXPECT_EQ(vel2_speeds(0xFB03), (WheelSpeeds{-5, 3}));
}

TEST(P2osCommand, EachRateHasItsCode) {
  EXPECT_EQ(baud_code(9600), 0);
  EXPECT_EQ(baud_code(19200), 1);
  EXPECT_EQ(baud_code(38400), 2);
  EXPECT_EQ(baud_code(57600), 3);
  EXPECT_EQ(baud_code(115200), 4);
  EXPECT_FALSE(baud_code(4800));
  EXPECT_EQ(baud_of_code(2), 38400U);
  EXPECT_FALSE(baud_of_code(5));
  EXPECT_FALSE(baud_of_code(-1));
}

RC_GTEST_PROP(P2osCommand, AnySpeedsOfTheWheelsComeBack, (std::int8_t left, std::int8_t right)) {
  RC_ASSERT(vel2_speeds(vel2_argument({left, right})) == (WheelSpeeds{left, right}));
}

RC_GTEST_PROP(P2osCommand, AnyIntegerComesBack, (std::uint8_t number)) {
  const int argument = *rc::gen::inRange(-kMaxArgument, kMaxArgument + 1);
  const Command command{number, argument};
  PacketReader reader;
  reader.feed(encode_command(command));
  RC_ASSERT(*parse_command(*reader.next()) == command);
}

RC_GTEST_PROP(P2osCommand, AnyTextComesBack, (std::uint8_t number, std::string text)) {
  text.resize(std::min<std::size_t>(text.size(), 100));
  const Command command{number, text};
  PacketReader reader;
  reader.feed(encode_command(command));
  RC_ASSERT(*parse_command(*reader.next()) == command);
}

}  // namespace
}  // namespace seeker::p2os
