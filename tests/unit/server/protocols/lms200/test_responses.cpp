#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/protocols/lms200/responses.hpp"
#include "server/protocols/lms200/scan_telegram.hpp"
#include "server/protocols/lms200/status_block.hpp"
#include "tests/unit/server/protocols/lms200/telegram_bytes.hpp"

namespace seeker::lms200 {
namespace {

constexpr std::uint8_t kGood = StatusByte::kGood;

rc::Gen<std::uint8_t> any_byte() { return rc::gen::arbitrary<std::uint8_t>(); }
rc::Gen<std::uint16_t> any_word() { return rc::gen::arbitrary<std::uint16_t>(); }

ConfigBlock any_config() {
  const Bytes bytes = *rc::gen::container<Bytes>(ConfigBlock::kBytes, any_byte());
  return decode_config(std::span(bytes).first<ConfigBlock::kBytes>());
}

RC_GTEST_PROP(Lms200Config, AnyBytesAreABlockThatIsWrittenAsItCame, ()) {
  const Bytes bytes = *rc::gen::container<Bytes>(ConfigBlock::kBytes, any_byte());
  const auto back = encode(decode_config(std::span(bytes).first<ConfigBlock::kBytes>()));
  RC_ASSERT(Bytes(back.begin(), back.end()) == bytes);
}

TEST(Lms200Config, FieldsLieWhereTheDeviceHasThem) {
  ConfigBlock block;
  block.availability = ConfigBlock::kRealTimeIndex;
  block.measuring_mode = 0x05;
  block.unit = 1;
  block.dazzle_multiple_evaluation = 0x0201;
  const auto bytes = encode(block);
  EXPECT_EQ(bytes[2], 70);
  EXPECT_EQ(bytes[4], 2);
  EXPECT_EQ(bytes[5], 0x05);
  EXPECT_EQ(bytes[6], 1);
  EXPECT_EQ(bytes[9], 2);
  EXPECT_EQ(bytes[32], 1);
  EXPECT_EQ(bytes[33], 2);
  EXPECT_TRUE(block.real_time_index());
}

TEST(Lms200Config, AShortWriteKeepsTheOtherBytes) {
  ConfigBlock block;
  block.restart = 9;
  block.dazzle_multiple_evaluation = 77;
  const ConfigBlock changed = overwritten(block, bytes_of("00 00 46 03 00 06 01"));
  EXPECT_EQ(changed.peak_threshold, 3);
  EXPECT_EQ(changed.measuring_mode, 6);
  EXPECT_EQ(changed.unit, 1);
  EXPECT_EQ(changed.restart, 9);
  EXPECT_EQ(changed.dazzle_multiple_evaluation, 77);
}

RC_GTEST_PROP(Lms200Response, RepliesAreReadAsTheyWereWritten, ()) {
  const auto mode = static_cast<ModeResult>(*rc::gen::inRange(0, 3));
  RC_ASSERT(*decode_mode_result(encode(mode, kGood)) == mode);
  const VariantReply variant{*rc::gen::arbitrary<bool>(), {*any_word(), *any_word()}};
  RC_ASSERT(*decode_variant(encode(variant, kGood)) == variant);
  const ConfigBlock config = any_config();
  RC_ASSERT(*decode_config_reply(encode_config(config, kGood)) == config);
  const ConfigWrittenReply written{*rc::gen::arbitrary<bool>(), config};
  RC_ASSERT(*decode_config_written(encode(written, kGood)) == written);
  std::vector<DeviceError> errors(*rc::gen::inRange<std::size_t>(0, 20));
  for (DeviceError& error : errors) {
    error = {*any_byte(), *any_byte()};
  }
  RC_ASSERT(*decode_errors(encode(errors, kGood)) == errors);
}

TEST(Lms200Response, TextIsCutToATelegramAndMadePrintable) {
  const std::string type = "LMS200;30106;V02.30";
  EXPECT_EQ(*decode_text(encode_text(response_code::kType, type, kGood)), type);
  EXPECT_EQ(encode_text(response_code::kType, std::string(2000, 'x'), kGood).size(), kMaxPayloadBytes);
  EXPECT_EQ(*decode_text(bytes_of("BA 41 00 0A FF 42 10")), "A???B");
}

TEST(Lms200Response, OtherLengthsAreRefused) {
  const Bytes lone = bytes_of("A0");
  EXPECT_FALSE(decode_mode_result(bytes_of("A0 00")).has_value());
  EXPECT_FALSE(decode_mode_result(bytes_of("A0 07 10")).has_value());
  EXPECT_FALSE(decode_variant(bytes_of("BB 01 B4 00 32 00")).has_value());
  EXPECT_FALSE(decode_config_reply(Bytes(35, 0)).has_value());
  EXPECT_FALSE(decode_config_written(Bytes(36, 0)).has_value());
  EXPECT_FALSE(decode_errors(bytes_of("B2 01 10")).has_value());
  EXPECT_FALSE(decode_text(lone).has_value());
  EXPECT_FALSE(decode_errors(lone).has_value());
}

StatusBlock sample_status() {
  StatusBlock block;
  block.software_version = "V02.30 ";
  block.prom_version = "X01.20 ";
  block.operating_mode = 0x25;
  block.defective = true;
  block.variant_code = 2;
  block.pollution = {1, 2, 3, 4, 5, 6, 7, 800};
  block.reference_pollution = {9, 10, 11, 1200};
  block.pollution_calibration = {21, 22, 23, 24, 25, 26, 27, 2800};
  block.reference_calibration = {29, 30, 31, 3200};
  block.mirror_rotations = 4500;
  block.measuring_mode = 5;
  block.variant = {180, 50};
  block.restart_mode = 2;
  block.restart_time = 300;
  block.baud_word = 0x8019;
  block.permanent_baud = true;
  block.address = 1;
  block.field_set = 2;
  block.unit = 1;
  block.laser_on = true;
  return block;
}

TEST(Lms200Status, TheBlockHas152BytesAndComesBack) {
  const Bytes payload = encode(sample_status(), kGood);
  EXPECT_EQ(payload.size(), 152U);
  EXPECT_EQ(payload.front(), 0xB1);
  EXPECT_EQ(payload.back(), kGood);
  EXPECT_EQ(*decode_status_block(payload), sample_status());
}

TEST(Lms200Status, FieldsLieWhereProgramsLookForThem) {
  const Bytes payload = encode(sample_status(), kGood);
  EXPECT_EQ(std::string(payload.begin() + 1, payload.begin() + 8), "V02.30 ");
  EXPECT_EQ(payload[8], 0x25);
  EXPECT_EQ(payload[67] + 256 * payload[68], 4500);
  EXPECT_EQ(payload[102], 5);
  EXPECT_EQ(payload[107] + 256 * payload[108], 180);
  EXPECT_EQ(payload[109] + 256 * payload[110], 50);
  EXPECT_EQ(payload[116] + 256 * payload[117], 0x8019);
  EXPECT_EQ(payload[122], 1);
}

TEST(Lms200Status, ABlockThatEndsEarlyIsRefused) {
  const Bytes payload = encode(sample_status(), kGood);
  for (std::size_t size = 1; size <= 131; ++size) {
    EXPECT_FALSE(decode_status_block(std::span(payload).first(size)).has_value());
  }
  EXPECT_TRUE(decode_status_block(std::span(payload).first(132)).has_value());
}

TEST(Lms200Scan, AScanOf361ValuesIs732BytesOnTheWire) {
  ScanTelegram scan;
  scan.unit = Unit::kMillimetre;
  scan.words.assign(361, 1234);
  const Bytes telegram = encode_telegram(Sender::kDevice, encode(scan, kGood));
  EXPECT_EQ(telegram.size(), 732U);
  EXPECT_EQ(Bytes(telegram.begin(), telegram.begin() + 9), bytes_of("02 80 D6 02 B0 69 41 D2 04"));
}

TEST(Lms200Scan, TheCountWordHoldsUnitAndPartialScan) {
  ScanTelegram scan;
  scan.words = {1, 2};
  EXPECT_EQ(encode(scan, kGood), bytes_of("B0 02 00 01 00 02 00 10"));
  scan.unit = Unit::kDecimetre;
  scan.partial = 3;
  EXPECT_EQ(encode(scan, kGood), bytes_of("B0 02 B8 01 00 02 00 10"));
}

TEST(Lms200Scan, ASubRangeStandsInFrontOfTheCount) {
  ScanTelegram scan;
  scan.sub_range = SubRange{10, 11};
  scan.words = {1, 2};
  EXPECT_EQ(encode(scan, kGood), bytes_of("B7 0A 00 0B 00 02 00 01 00 02 00 10"));
}

RC_GTEST_PROP(Lms200Scan, AScanIsReadAsItWasWritten, (bool real_time, bool both)) {
  ScanTelegram scan;
  scan.unit = static_cast<Unit>(*rc::gen::inRange(0, 3));
  scan.words = *rc::gen::container<std::vector<std::uint16_t>>(*rc::gen::inRange<std::size_t>(1, 402), any_word());
  if (*rc::gen::arbitrary<bool>()) {
    scan.partial = static_cast<std::uint8_t>(*rc::gen::inRange(0, 4));
  }
  const auto count = static_cast<std::uint16_t>(scan.words.size());
  if (*rc::gen::arbitrary<bool>()) {
    const auto first = static_cast<std::uint16_t>(*rc::gen::inRange(1, 402 - count + 1));
    scan.sub_range = SubRange{first, static_cast<std::uint16_t>(first + count - 1)};
  }
  if (real_time || both) {
    scan.real_time_index = *any_byte();
  }
  if (!real_time || both) {
    scan.telegram_index = *any_byte();
  }
  const auto read = decode_scan(encode(scan, kGood), real_time);
  RC_ASSERT(read.has_value());
  RC_ASSERT(*read == scan);
}

TEST(Lms200Scan, ADeviceThatSendsNoIndexIsUnderstood) {
  const auto scan = decode_scan(bytes_of("B0 02 40 01 00 02 00 10"), true);
  ASSERT_TRUE(scan.has_value());
  EXPECT_EQ(scan->words, (std::vector<std::uint16_t>{1, 2}));
  EXPECT_FALSE(scan->real_time_index);
  EXPECT_FALSE(scan->telegram_index);
}

TEST(Lms200Scan, ContradictionsAreRefused) {
  for (const char* const hex : {"B0 10", "B0 01 00", "B0 02 00 01 00 10",  // fewer values than stated
                                "B0 01 00 01 00 09 09 09 10",              // more bytes than indices
                                "B0 01 C0 01 00 10",                       // no such unit
                                "B0 FF 03 01 00 10",                       // 1023 values
                                "B7 0A 00 0C 00 02 00 01 00 02 00 10",     // three values stated, two sent
                                "B7 00 00 01 00 02 00 01 00 02 00 10",     // values count from 1
                                "B7 0B 00 0A 00 00 00 10", "B7 01 00 01 00 10"}) {
    const auto scan = decode_scan(bytes_of(hex), false);
    ASSERT_FALSE(scan.has_value()) << hex;
    EXPECT_EQ(scan.error().code, Errc::kParse);
  }
}

RC_GTEST_PROP(Lms200Response, AnyBytesAreReadOrRefused, ()) {
  Bytes payload = *rc::gen::nonEmpty(rc::gen::container<Bytes>(any_byte()));
  (void)decode_command(payload);
  (void)decode_mode_result(payload);
  (void)decode_variant(payload);
  (void)decode_config_reply(payload);
  (void)decode_config_written(payload);
  (void)decode_errors(payload);
  (void)decode_text(payload);
  (void)decode_status_block(payload);
  payload[0] = payload[0] % 2 == 0 ? response_code::kValues : response_code::kSubRange;
  (void)decode_scan(payload, payload.size() % 2 == 0);
}

}  // namespace
}  // namespace seeker::lms200
