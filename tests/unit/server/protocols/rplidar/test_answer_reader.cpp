#include "server/protocols/rplidar/answer_reader.hpp"

#include <algorithm>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/protocols/rplidar/stream_cut.hpp"
#include "tests/unit/server/protocols/rplidar/streams.hpp"

namespace seeker::rplidar {
namespace {

using testing::append;
using testing::Bytes;
using testing::read_in_pieces;

constexpr std::size_t kHead = 5;   ///< records by which a reader comes to know a stream
constexpr std::size_t kTail = 20;  ///< records at the end of a stream that may still wait for their successors

/// A stream under construction: the records, and which of them arrive whole.
template <class T>
struct Stream {
  explicit Stream(const std::vector<T>& sent) : records(sent), whole(sent.size(), true) {
    append(bytes, encode(testing::descriptor_of(sent.front())));
  }

  /// The records that must come out.
  [[nodiscard]] std::vector<T> expected() const {
    std::vector<T> kept;
    for (std::size_t k = 0; k + kTail < records.size(); ++k) {
      if (whole[k]) {
        kept.push_back(records[k]);
      }
    }
    return kept;
  }

  std::vector<T> records;
  std::vector<bool> whole;
  Bytes bytes;
};

std::vector<LegacySample> records_of(const LegacySample& /*type*/, std::size_t count, Rng& rng) {
  return testing::turning_samples(count, rng);
}
std::vector<ExpressCapsule> records_of(const ExpressCapsule& /*type*/, std::size_t count, Rng& rng) {
  return testing::turning_capsules(count, rng);
}

template <class T>
std::vector<T> read_all(const Stream<T>& stream, std::size_t longest, Rng& rng) {
  AnswerReader reader;
  reader.expect(testing::descriptor_of(stream.records.front()).type);
  return read_in_pieces<T>(reader, stream.bytes, longest, rng);
}

/// Whether `wanted` comes in `got` in its order, perhaps with others between.
template <class T>
bool holds_all(const std::vector<T>& got, const std::vector<T>& wanted) {
  auto at = got.begin();
  return std::all_of(wanted.begin(), wanted.end(), [&](const T& one) {
    at = std::find(at, got.end(), one);
    return at != got.end() && (++at, true);
  });
}

/// A bit of a sample by which its damage can be seen: the check bits, or a high bit of the angle.
std::size_t telling_bit(const LegacySample& /*type*/, Rng& rng) {
  constexpr std::array<std::size_t, 6> kTelling{0, 1, 8, 20, 21, 22};
  return kTelling[rng.below(kTelling.size())];
}
std::size_t telling_bit(const ExpressCapsule& /*type*/, Rng& rng) { return rng.below(8 * kCapsuleBytes); }

template <class T>
void survives_damage(std::uint64_t seed) {
  Rng rng(seed);
  Stream<T> stream(records_of(T{}, 400, rng));
  for (std::size_t k = 0; k < stream.records.size(); ++k) {
    auto bytes = encode(stream.records[k]);
    if (k >= kHead && rng.below(100) == 0) {
      stream.whole[k] = false;
      const std::size_t bit = telling_bit(T{}, rng);
      bytes[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
    }
    append(stream.bytes, bytes);
  }
  std::vector<T> got = read_all(stream, 200, rng);
  const std::vector<T> wanted = stream.expected();
  RC_ASSERT(holds_all(got, wanted));
  got.resize(std::min(got.size(), wanted.size()));
  RC_ASSERT(got == wanted);
}

RC_GTEST_PROP(RplidarReader, OfSamplesOfWhichOneInAHundredIsDamagedAllOthersComeOut, ()) {
  survives_damage<LegacySample>(*rc::gen::arbitrary<std::uint64_t>());
}
RC_GTEST_PROP(RplidarReader, OfCapsulesOfWhichOneInAHundredIsDamagedAllOthersComeOut, ()) {
  survives_damage<ExpressCapsule>(*rc::gen::arbitrary<std::uint64_t>());
}

template <class T>
void any_cut_is_the_same(std::uint64_t seed) {
  Rng rng(seed);
  Stream<T> stream(records_of(T{}, 60, rng));
  for (const T& record : stream.records) {
    append(stream.bytes, encode(record));
  }
  for (std::uint64_t k = rng.below(30); k > 0; --k) {
    stream.bytes[kDescriptorBytes + rng.below(stream.bytes.size() - kDescriptorBytes)] ^=
        static_cast<std::uint8_t>(1 + rng.below(255));
  }
  Rng other(seed + 1);
  const std::vector<T> whole = read_all(stream, 100'000, rng);
  RC_ASSERT(read_all(stream, 1, other) == whole);
  RC_ASSERT(read_all(stream, 90, other) == whole);
}

RC_GTEST_PROP(RplidarReader, AnyCutOfDamagedSamplesGivesTheSame, ()) {
  any_cut_is_the_same<LegacySample>(*rc::gen::arbitrary<std::uint64_t>());
}
RC_GTEST_PROP(RplidarReader, AnyCutOfDamagedCapsulesGivesTheSame, ()) {
  any_cut_is_the_same<ExpressCapsule>(*rc::gen::arbitrary<std::uint64_t>());
}

/// The whole records that must come out and do not.
template <class T>
std::size_t missing(const Stream<T>& stream, Rng& rng) {
  const std::vector<T> got = read_all(stream, 200, rng);
  const std::vector<T> wanted = stream.expected();
  return static_cast<std::size_t>(std::count_if(
      wanted.begin(), wanted.end(), [&](const T& one) { return std::find(got.begin(), got.end(), one) == got.end(); }));
}

TEST(RplidarReader, EveryWholeCapsuleComesOutWhereGarbageIsPutBetween) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Rng rng(seed);
    Stream<ExpressCapsule> stream(testing::turning_capsules(100, rng));
    for (const ExpressCapsule& capsule : stream.records) {
      append(stream.bytes, encode(capsule));
      for (std::uint64_t garbage = rng.below(10) == 0 ? 1 + rng.below(300) : 0; garbage > 0; --garbage) {
        stream.bytes.push_back(static_cast<std::uint8_t>(rng.below(256)));
      }
    }
    EXPECT_EQ(missing(stream, rng), 0U) << "seed " << seed;
  }
}

/// Loses bytes at any place of a capsule, up to all of them.
Stream<ExpressCapsule> lossy_capsules(Rng& rng) {
  Stream<ExpressCapsule> stream(testing::turning_capsules(100, rng));
  for (std::size_t k = 0; k < stream.records.size(); ++k) {
    const auto encoded = encode(stream.records[k]);
    const std::size_t from = k % 10 == 5 ? rng.below(kCapsuleBytes) : kCapsuleBytes;
    const std::size_t to = from + (from < kCapsuleBytes ? 1 + rng.below(kCapsuleBytes - from) : 0);
    stream.whole[k] = from == kCapsuleBytes;
    append(stream.bytes, std::span(encoded).first(from));
    append(stream.bytes, std::span(encoded).subspan(to));
  }
  return stream;
}

TEST(RplidarReader, EveryWholeCapsuleComesOutWhereBytesAreLost) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Rng rng(seed);
    EXPECT_EQ(missing(lossy_capsules(rng), rng), 0U) << "seed " << seed;
  }
}

/// Loses bytes of every 50th sample; the one before it counts as lost too, for it has no successor.
Stream<LegacySample> lossy_samples(Rng& rng) {
  Stream<LegacySample> stream(testing::turning_samples(400, rng));
  for (std::size_t k = 0; k < stream.records.size(); ++k) {
    const auto encoded = encode(stream.records[k]);
    const std::size_t lost = k % 50 == 25 ? 1 + rng.below(kLegacyBytes - 1) : 0;
    if (lost > 0) {
      stream.whole[k] = stream.whole[k - 1] = false;
    }
    append(stream.bytes, std::span(encoded).subspan(lost));
  }
  return stream;
}

TEST(RplidarReader, ALossOfBytesCostsSamplesBesideItOnly) {
  // Where the stream is shifted, check bits and angles may agree by chance: twice in a thousand losses.
  std::size_t lost = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    Rng rng(seed);
    lost += missing(lossy_samples(rng), rng);
  }
  EXPECT_LE(lost, 10U) << "of 3200 losses";
}

TEST(RplidarReader, TellsTheGapAndTheBytesBehind) {
  Rng rng(5);
  const auto capsules = testing::turning_capsules(4, rng);
  Stream<ExpressCapsule> stream(capsules);
  append(stream.bytes, encode(capsules[0]));
  auto damaged = encode(capsules[1]);
  damaged[40] ^= 0x10;
  append(stream.bytes, damaged);
  append(stream.bytes, encode(capsules[2]));
  append(stream.bytes, encode(capsules[3]));
  stream.bytes.insert(stream.bytes.end(), {0xA0, 0x50});
  AnswerReader reader;
  reader.expect(AnswerType::kExpressScan);
  EXPECT_FALSE(reader.streaming());
  const std::vector<Answer> answers = reader.read(stream.bytes);
  EXPECT_TRUE(reader.streaming());
  ASSERT_EQ(answers.size(), 3U);
  EXPECT_FALSE(answers[0].after_gap);
  EXPECT_TRUE(answers[1].after_gap);
  EXPECT_FALSE(answers[2].after_gap);
  EXPECT_EQ(answers[0].bytes_behind, 3 * kCapsuleBytes + 2);
  EXPECT_EQ(answers[2].bytes_behind, 2U);
  EXPECT_EQ(reader.counts().whole, 3U);
  EXPECT_EQ(reader.counts().damaged, 1U);
  EXPECT_EQ(reader.counts().skipped, kCapsuleBytes);
}

TEST(RplidarReader, AnAngleThatWasDamagedIsNotDelivered) {
  std::vector<LegacySample> sent;
  for (std::uint16_t k = 0; k < 30; ++k) {
    sent.push_back({false, 10, static_cast<std::uint16_t>(6400 + 64 * k), 4000});
  }
  Stream<LegacySample> stream(sent);
  for (std::size_t k = 0; k < sent.size(); ++k) {
    LegacySample one = sent[k];
    one.angle_q6 ^= k == 10 ? 0x1000 : 0;
    append(stream.bytes, encode(one));
  }
  stream.whole[10] = false;
  Rng rng(1);
  std::vector<LegacySample> got = read_all(stream, 7, rng);
  got.resize(stream.expected().size());
  EXPECT_EQ(got, stream.expected());
}

TEST(RplidarReader, HoldsFewBytesOfAFlood) {
  // What it does not return it has skipped, but for less than it looks at.
  for (const AnswerType type : {AnswerType::kLegacyScan, AnswerType::kExpressScan, AnswerType::kInfo}) {
    Rng rng(6);
    Bytes bytes;
    const std::size_t record = type == AnswerType::kLegacyScan ? kLegacyBytes : kCapsuleBytes;
    append(bytes, encode(Descriptor{static_cast<std::uint32_t>(record), type != AnswerType::kInfo, type}));
    for (int k = 0; k < 20'000; ++k) {
      bytes.push_back(static_cast<std::uint8_t>(rng.below(256)));
    }
    AnswerReader reader;
    reader.expect(type);
    (void)reader.read(bytes);
    EXPECT_GT(reader.counts().skipped + record * reader.counts().whole + kDescriptorBytes + kMaxStreamLook,
              bytes.size());
  }
}

}  // namespace
}  // namespace seeker::rplidar
