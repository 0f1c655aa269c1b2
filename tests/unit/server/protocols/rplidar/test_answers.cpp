#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/core/angle.hpp"
#include "server/protocols/rplidar/answer_reader.hpp"
#include "server/protocols/rplidar/capsule_chain.hpp"
#include "tests/unit/server/protocols/rplidar/streams.hpp"

namespace seeker::rplidar {
namespace {

using testing::append;
using testing::Bytes;
using ::testing::ElementsAre;

TEST(RplidarDescriptor, TheVectorsOfTheManualAreWrittenAndReadByteForByte) {
  const std::vector<std::pair<Descriptor, Bytes>> vectors{
      {{5, true, AnswerType::kLegacyScan}, {0xA5, 0x5A, 0x05, 0, 0, 0x40, 0x81}},
      {{84, true, AnswerType::kExpressScan}, {0xA5, 0x5A, 0x54, 0, 0, 0x40, 0x82}},
      {{20, false, AnswerType::kInfo}, {0xA5, 0x5A, 0x14, 0, 0, 0, 0x04}},
      {{3, false, AnswerType::kHealth}, {0xA5, 0x5A, 0x03, 0, 0, 0, 0x06}},
      {{4, false, AnswerType::kSampleRate}, {0xA5, 0x5A, 0x04, 0, 0, 0, 0x15}}};
  for (const auto& [descriptor, bytes] : vectors) {
    const auto written = encode(descriptor);
    EXPECT_EQ(Bytes(written.begin(), written.end()), bytes);
    EXPECT_EQ(decode_descriptor(bytes), descriptor);
  }
}

TEST(RplidarDescriptor, OtherBytesAndReservedModesAreNone) {
  EXPECT_FALSE(decode_descriptor(Bytes{0xA5, 0x5B, 0x05, 0, 0, 0x40, 0x81}));
  EXPECT_FALSE(decode_descriptor(Bytes{0xA5, 0x5A, 0x05, 0, 0, 0x80, 0x81}));
  EXPECT_FALSE(decode_descriptor(Bytes{0xA5, 0x5A, 0x05, 0, 0, 0x40}));
}

const DeviceInfo kA1{0x18, {1, 20}, 5, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16}};

TEST(RplidarAnswers, EachSingleAnswerIsReadAsItWasWritten) {
  const auto back = [](AnswerType type, const auto& value) {
    AnswerReader reader;
    reader.expect(type);
    const std::vector<Answer> answers = reader.read(encode(value));
    return answers.size() == 1 && answers.front().value == AnswerValue(value) && answers.front().bytes_behind == 0;
  };
  EXPECT_TRUE(back(AnswerType::kInfo, kA1));
  EXPECT_TRUE(back(AnswerType::kHealth, Health{HealthStatus::kProtectionStop, 0x8002}));
  EXPECT_TRUE(back(AnswerType::kSampleRate, SampleRate{508, 254}));
  EXPECT_TRUE(back(AnswerType::kConf, ConfAnswer{ConfType::kTypicalMode, {1, 0}}));
  EXPECT_TRUE(back(AnswerType::kAccBoard, AccBoard{true}));
}

TEST(RplidarAnswers, TheBytesOfAnInfoAreThoseOfTheManual) {
  const Bytes bytes = encode(kA1);
  EXPECT_EQ(Bytes(bytes.begin() + 7, bytes.begin() + 12), (Bytes{0x18, 20, 1, 5, 1}));
  EXPECT_EQ(kA1.series(), 1U);
  EXPECT_LT(kA1.firmware, (Firmware{1, 24}));
  EXPECT_GT((Firmware{2, 0}), (Firmware{1, 24}));
}

TEST(RplidarAnswers, AHealthThatDoesNotExistIsRefused) {
  AnswerReader reader;
  reader.expect(AnswerType::kHealth);
  Bytes bytes = encode(Health{});
  bytes[kDescriptorBytes] = 9;
  EXPECT_TRUE(reader.read(bytes).empty());
  EXPECT_EQ(reader.counts().damaged, 1U);
  EXPECT_EQ(reader.read(encode(Health{})).size(), 1U);
}

TEST(RplidarAnswers, TheTextOfABootAndOtherAnswersAreSkipped) {
  const std::string banner = "RP LIDAR System.\r\nFirmware Ver 1.20 HW Ver 5\r\nModel: 18\r\n";
  Bytes bytes(banner.begin(), banner.end());
  append(bytes, encode(Health{}));
  append(bytes, encode(kA1));
  AnswerReader reader;
  reader.expect(AnswerType::kInfo);
  const std::vector<Answer> answers = reader.read(bytes);
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_EQ(std::get<DeviceInfo>(answers.front().value), kA1);
  EXPECT_EQ(reader.counts().skipped, banner.size() + kDescriptorBytes + kHealthBytes);
}

TEST(RplidarAnswers, ADescriptorOfAnImpossibleLengthIsNotWaitedFor) {
  AnswerReader reader;
  reader.expect(AnswerType::kConf);
  Bytes bytes;
  append(bytes, encode(Descriptor{kMaxAnswerLength, false, AnswerType::kConf}));
  append(bytes, encode(ConfAnswer{ConfType::kAnswerType, {0x82}}));
  EXPECT_EQ(reader.read(bytes).size(), 1U);
}

TEST(RplidarLegacySample, BitsAreWhereTheManualHasThem) {
  const LegacySample sample{true, 0x2A, 0x1234, 0x4321};
  const auto bytes = encode(sample);
  EXPECT_THAT(bytes, ElementsAre(0xA9, 0x69, 0x24, 0x21, 0x43));
  EXPECT_EQ(decode_legacy(bytes), sample);
}

TEST(RplidarLegacySample, WrongCheckBitsAreRefused) {
  const auto good = encode(LegacySample{false, 10, 100, 400});
  for (const auto& [byte, bit] : std::vector<std::pair<std::size_t, unsigned>>{{0, 0}, {0, 1}, {1, 0}}) {
    auto bad = good;
    bad[byte] ^= static_cast<std::uint8_t>(1U << bit);
    EXPECT_FALSE(decode_legacy(bad));
  }
}

TEST(RplidarLegacySample, UnitsAreRadiansAndMetresAndZeroIsNoEcho) {
  const PolarSample sample = to_polar(LegacySample{false, 20, 90 * 64, 4000});
  EXPECT_NEAR(sample.angle_cw_rad, kPi / 2.0, 1e-12);
  EXPECT_FLOAT_EQ(sample.range_m, 1.0F);
  EXPECT_EQ(sample.quality, 20);
  EXPECT_EQ(to_polar(LegacySample{false, 20, 0, 0}), (PolarSample{0.0, kNoReturn, 0}));
}

TEST(RplidarCapsule, BitsAreWhereTheManualHasThem) {
  ExpressCapsule capsule;
  capsule.first = true;
  capsule.start_angle_q6 = 0x1234;
  capsule.samples[0] = {0x0123, 0x1B};
  capsule.samples[1] = {0x3FFF, 0x3C};
  const auto bytes = encode(capsule);
  EXPECT_THAT(Bytes(bytes.begin() + 2, bytes.begin() + 9), ElementsAre(0x34, 0x92, 0x8D, 0x04, 0xFF, 0xFF, 0xCB));
  std::uint8_t sum = 0;
  for (std::size_t k = 2; k < kCapsuleBytes; ++k) {
    sum ^= bytes[k];
  }
  EXPECT_EQ(bytes[0], 0xA0 | (sum & 0x0F));
  EXPECT_EQ(bytes[1], 0x50 | (sum >> 4));
  EXPECT_EQ(decode_capsule(bytes), capsule);
}

TEST(RplidarCapsule, AnyFlippedBitIsNoticed) {
  Rng rng(7);
  const auto good = encode(testing::turning_capsules(1, rng).front());
  for (std::size_t bit = 0; bit < 8 * kCapsuleBytes; ++bit) {
    auto bad = good;
    bad[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
    EXPECT_FALSE(decode_capsule(bad)) << "bit " << bit;
  }
}

TEST(RplidarCapsule, AnglesLieEvenlyBetweenTwoStartsLessTheirCompensation) {
  ExpressCapsule capsule;
  capsule.start_angle_q6 = 350 * 64;
  capsule.samples[0] = {1000, 0};
  capsule.samples[16] = {2000, 8};  // a degree
  const auto samples = to_polar(capsule, 32 * 64);
  EXPECT_NEAR(samples[0].angle_cw_rad, deg_to_rad(350.0), 1e-9);
  EXPECT_NEAR(samples[16].angle_cw_rad, deg_to_rad(5.0), 1e-9);
  EXPECT_FLOAT_EQ(samples[16].range_m, 2.0F);
  EXPECT_EQ(samples[16].quality, kCapsuleQuality);
  EXPECT_EQ(samples[1].range_m, kNoReturn);
  EXPECT_EQ(samples[1].quality, 0);
}

TEST(RplidarCapsuleChain, ReturnsTheOneBeforeAndOnlyItsDirectPredecessor) {
  Rng rng(3);
  const auto capsules = testing::turning_capsules(6, rng);
  CapsuleChain chain;
  EXPECT_FALSE(chain.add(capsules[0], false));
  EXPECT_TRUE(chain.add(capsules[1], false));
  EXPECT_TRUE(chain.add(capsules[2], false));
  EXPECT_FALSE(chain.add(capsules[4], true)) << "told that bytes were lost";
  EXPECT_TRUE(chain.add(capsules[5], false));
  ExpressCapsule anew = capsules[3];
  anew.first = true;
  EXPECT_FALSE(chain.add(anew, false)) << "another scan has begun";
}

TEST(RplidarCapsuleChain, ACapsuleThatVanishedAsAWholeIsNoticedByTheAngle) {
  Rng rng(4);
  const auto capsules = testing::turning_capsules(5, rng);
  CapsuleChain chain;
  EXPECT_FALSE(chain.add(capsules[0], false));
  EXPECT_TRUE(chain.add(capsules[1], false));
  EXPECT_FALSE(chain.add(capsules[3], false));
  EXPECT_TRUE(chain.add(capsules[4], false));
}

RC_GTEST_PROP(RplidarLegacySample, ComesBackAsItWasWritten, ()) {
  const LegacySample sample{*rc::gen::arbitrary<bool>(), *rc::gen::inRange<std::uint8_t>(0, 64),
                            *rc::gen::inRange<std::uint16_t>(0, 0x8000), *rc::gen::arbitrary<std::uint16_t>()};
  RC_ASSERT(decode_legacy(encode(sample)) == sample);
}

RC_GTEST_PROP(RplidarCapsule, ComesBackAsItWasWritten, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  ExpressCapsule capsule = testing::turning_capsules(1, rng).front();
  for (CapsuleSample& sample : capsule.samples) {
    sample.compensation_q3 = static_cast<std::uint8_t>(rng.below(64));
  }
  RC_ASSERT(decode_capsule(encode(capsule)) == capsule);
}

}  // namespace
}  // namespace seeker::rplidar
