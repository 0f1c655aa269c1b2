#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/protocols/lms200/commands.hpp"
#include "server/protocols/lms200/crc.hpp"
#include "server/protocols/lms200/responses.hpp"
#include "tests/unit/server/protocols/lms200/telegram_bytes.hpp"

namespace seeker::lms200 {
namespace {

Bytes command_bytes(const Command& command) { return encode_telegram(Sender::kHost, encode(command)); }

TEST(Lms200Telegram, LoneCommandsAreTheDocumentedBytes) {
  EXPECT_EQ(command_bytes(Reset{}), bytes_of("02 00 01 00 10 34 12"));
  EXPECT_EQ(command_bytes(RequestType{}), bytes_of("02 00 01 00 3A 1E 12"));
  EXPECT_EQ(command_bytes(RequestStatus{}), bytes_of("02 00 01 00 31 15 12"));
  EXPECT_EQ(command_bytes(RequestErrors{}), bytes_of("02 00 01 00 32 16 12"));
  EXPECT_EQ(command_bytes(RequestConfig{}), bytes_of("02 00 01 00 74 50 12"));
}

TEST(Lms200Telegram, ChangesOfModeAreTheDocumentedBytes) {
  EXPECT_EQ(command_bytes(SetMode{operating_mode::kContinuous, {}}), bytes_of("02 00 02 00 20 24 34 08"));
  EXPECT_EQ(command_bytes(SetMode{operating_mode::kRequest, {}}), bytes_of("02 00 02 00 20 25 35 08"));
  EXPECT_EQ(command_bytes(SetMode{0x40, {}}), bytes_of("02 00 02 00 20 40 50 08"));
  EXPECT_EQ(command_bytes(SetMode{0x41, {}}), bytes_of("02 00 02 00 20 41 51 08"));
  EXPECT_EQ(command_bytes(SetMode{0x42, {}}), bytes_of("02 00 02 00 20 42 52 08"));
  EXPECT_EQ(command_bytes(SetMode{0x48, {}}), bytes_of("02 00 02 00 20 48 58 08"));
  EXPECT_EQ(command_bytes(enter_installation()), bytes_of("02 00 0A 00 20 00 53 49 43 4B 5F 4C 4D 53 BE C5"));
}

TEST(Lms200Telegram, VariantsAreTheDocumentedBytes) {
  EXPECT_EQ(command_bytes(SetVariant{{180, 50}}), bytes_of("02 00 05 00 3B B4 00 32 00 3B 1F"));
  EXPECT_EQ(command_bytes(SetVariant{{180, 100}}), bytes_of("02 00 05 00 3B B4 00 64 00 97 49"));
  EXPECT_EQ(command_bytes(SetVariant{{100, 25}}), bytes_of("02 00 05 00 3B 64 00 19 00 E7 72"));
}

TEST(Lms200Telegram, ResponsesAreTheDocumentedBytes) {
  EXPECT_EQ(encode_telegram(Sender::kDevice, encode(ModeResult::kDone, StatusByte::kGood)),
            bytes_of("02 80 03 00 A0 00 10 16 0A"));
  EXPECT_EQ(encode_telegram(Sender::kDevice, encode(VariantReply{true, {180, 50}}, StatusByte::kGood)),
            bytes_of("02 80 07 00 BB 01 B4 00 32 00 10 03 9D"));
}

TEST(Lms200Telegram, OneWrongBitAnywhereChangesTheChecksum) {
  const Bytes bytes = bytes_of("02 80 07 00 BB 01 B4 00 32 00 10");
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    Bytes damaged = bytes;
    damaged[bit / 8] = static_cast<std::uint8_t>(damaged[bit / 8] ^ (1U << (bit % 8)));
    EXPECT_NE(crc16(damaged), crc16(bytes)) << bit;
  }
}

TEST(Lms200Telegram, AScanOf361ValuesNeeds191MillisecondsAt38400Baud) {
  EXPECT_NEAR(to_seconds(transfer_time(732, 38400)), 0.191, 0.0005);
}

TEST(Lms200StatusByte, LevelAndPollutionAreSeparate) {
  EXPECT_EQ(StatusByte(0x10).level(), StatusByte::Level::kNone);
  EXPECT_FALSE(StatusByte(0x10).polluted());
  EXPECT_EQ(StatusByte::of(StatusByte::Level::kFatal, false).raw(), 0x14);
  EXPECT_EQ(StatusByte::of(StatusByte::Level::kWarning, true).raw(), 0x92);
  EXPECT_TRUE(StatusByte(0x92).polluted());
  EXPECT_EQ(StatusByte(0x17).level(), StatusByte::Level::kFatal);
}

RC_GTEST_PROP(Lms200Command, EachCommandIsReadAsItWasWritten, ()) {
  const auto byte = rc::gen::arbitrary<std::uint8_t>();
  const auto word = rc::gen::arbitrary<std::uint16_t>();
  const std::vector<Command> commands{
      Reset{},
      SetMode{*byte, *rc::gen::container<Bytes>(byte)},
      RequestValues{*byte},
      RequestStatus{},
      RequestErrors{},
      RequestType{},
      SetVariant{{*word, *word}},
      RequestConfig{},
      SetConfig{*rc::gen::container<Bytes>(*rc::gen::inRange<std::size_t>(1, ConfigBlock::kBytes + 1), byte)}};
  for (const Command& command : commands) {
    const Result<Command> read = decode_command(encode(command));
    RC_ASSERT(read.has_value());
    RC_ASSERT(*read == command);
  }
}

TEST(Lms200Command, UnknownCodesAndOtherLengthsAreRefused) {
  for (const char* const hex : {"00", "FF", "10 00", "20", "30", "31 00", "3B B4 00 32", "77", "3A 01"}) {
    const Result<Command> read = decode_command(bytes_of(hex));
    ASSERT_FALSE(read.has_value()) << hex;
    EXPECT_EQ(read.error().code, Errc::kParse);
  }
  EXPECT_FALSE(decode_command(Bytes(2 + ConfigBlock::kBytes, command_code::kSetConfig)).has_value());
}

TEST(Lms200Command, ASubRangeHasTwoWords) {
  EXPECT_EQ(encode(continuous_sub_range({91, 271})), bytes_of("20 27 5B 00 0F 01"));
  EXPECT_EQ(*sub_range_of(continuous_sub_range({91, 271})), (SubRange{91, 271}));
  EXPECT_FALSE(sub_range_of(SetMode{operating_mode::kContinuousSubRange, {1, 0, 9}}).has_value());
}

}  // namespace
}  // namespace seeker::lms200
