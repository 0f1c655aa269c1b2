#include <algorithm>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/core/rng.hpp"
#include "server/protocols/lms200/crc.hpp"
#include "tests/support/random_bytes.hpp"
#include "tests/unit/server/protocols/lms200/telegram_bytes.hpp"

namespace seeker::lms200 {
namespace {

using testing::random_bytes;
using Kind = Received::Kind;

Bytes device_telegram(const Bytes& payload) { return encode_telegram(Sender::kDevice, payload); }

rc::Gen<Bytes> any_payload() {
  return rc::gen::withSize([](int size) {
    return rc::gen::mapcat(rc::gen::inRange(1, 2 + 4 * size), [](int length) {
      return rc::gen::container<Bytes>(static_cast<std::size_t>(length), rc::gen::arbitrary<std::uint8_t>());
    });
  });
}

/// Random bytes without a start byte, so that no telegram can be taken for its continuation.
Bytes quiet_garbage(Rng& rng, std::size_t size) {
  Bytes bytes = random_bytes(rng, size);
  std::replace(bytes.begin(), bytes.end(), kStx, std::uint8_t{0});
  return bytes;
}

RC_GTEST_PROP(Lms200Reader, AnyPiecesOfTheStreamGiveTheSameTelegrams, ()) {
  const auto payloads = *rc::gen::container<std::vector<Bytes>>(any_payload());
  const auto chunk = *rc::gen::inRange<std::size_t>(1, 300);
  Bytes stream;
  for (const Bytes& payload : payloads) {
    append(stream, device_telegram(payload));
  }
  TelegramReader reader(Sender::kDevice);
  RC_ASSERT(payloads_of(all_received(reader, stream, chunk)) == payloads);
  RC_ASSERT(!reader.partial());
  RC_ASSERT(reader.bytes_skipped() == 0U);
  RC_ASSERT(reader.bytes_in() == stream.size());
}

TEST(Lms200Reader, GarbageBetweenTelegramsIsSkippedAndTheNextTelegramDelivered) {
  Rng rng(7);
  for (int run = 0; run < 500; ++run) {
    const Bytes payload = quiet_garbage(rng, 1 + rng.below(40));
    Bytes stream = random_bytes(rng, rng.below(60));
    append(stream, device_telegram(payload));
    append(stream, Bytes(kMaxTelegramBytes, 0));  // whatever the garbage announced is over
    TelegramReader reader(Sender::kDevice);
    EXPECT_EQ(payloads_of(all_received(reader, stream, 1 + rng.below(50))), std::vector<Bytes>{payload}) << run;
  }
}

TEST(Lms200Reader, OfAStreamWithOnePercentDamagedTelegramsAllOthersAreDelivered) {
  Rng rng(11);
  Bytes stream;
  std::vector<Bytes> good;
  for (int i = 0; i < 3000; ++i) {
    Bytes payload = random_bytes(rng, 1 + rng.below(rng.below(4) == 0 ? kMaxPayloadBytes : 20));
    Bytes telegram = device_telegram(payload);
    if (rng.below(100) == 0) {
      // Anywhere, the start, the address and the length included.
      const std::size_t at = rng.below(telegram.size());
      telegram[at] = static_cast<std::uint8_t>(telegram[at] ^ (1U << rng.below(8)));
    } else {
      good.push_back(payload);
    }
    append(stream, telegram);
  }
  append(stream, Bytes(kMaxTelegramBytes, 0));
  TelegramReader reader(Sender::kDevice);
  EXPECT_EQ(payloads_of(all_received(reader, stream, 64)), good);
  EXPECT_GT(reader.damaged(), 0U);
}

TEST(Lms200Reader, ATelegramInsideADamagedOneIsFound) {
  Bytes stream = bytes_of("02 80 20 00 B0");  // announces 32 bytes, which never come
  append(stream, device_telegram(bytes_of("A0 00 10")));
  append(stream, Bytes(40, 0));
  TelegramReader reader(Sender::kDevice);
  EXPECT_EQ(payloads_of(all_received(reader, stream, 3)), std::vector<Bytes>{bytes_of("A0 00 10")});
  EXPECT_EQ(reader.damaged(), 1U);
}

TEST(Lms200Reader, ATelegramBehindOneThatWasCutIsFoundOnceTheRestIsAbandoned) {
  Bytes stream = bytes_of("02 80 20 03 B0");
  append(stream, device_telegram(bytes_of("A0 00 10")));
  TelegramReader reader(Sender::kDevice);
  EXPECT_TRUE(all_received(reader, stream, 100).empty());
  ASSERT_TRUE(reader.partial());
  reader.abandon_partial();
  const auto received = reader.next();
  ASSERT_TRUE(received);
  EXPECT_EQ(received->payload, bytes_of("A0 00 10"));
  EXPECT_EQ(received->first_byte, 5U);
  EXPECT_EQ(received->end_byte, stream.size());
  EXPECT_FALSE(reader.partial());
}

TEST(Lms200Reader, AcknowledgementsBetweenTelegramsAreReported) {
  Bytes stream = bytes_of("15 06");
  append(stream, device_telegram(bytes_of("A0 00 10")));
  stream.push_back(kAckByte);
  TelegramReader reader(Sender::kDevice);
  const auto all = all_received(reader, stream, 1);
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(all[0].kind, Kind::kNak);
  EXPECT_EQ(all[1].kind, Kind::kAck);
  EXPECT_EQ(all[2].kind, Kind::kTelegram);
  EXPECT_EQ(all[3].kind, Kind::kAck);
  EXPECT_EQ(reader.bytes_skipped(), 0U);
}

TEST(Lms200Reader, BytesOfADamagedTelegramAreNoAcknowledgements) {
  Bytes stream = device_telegram(bytes_of("B0 06 15 06 15 10"));
  stream.back() = static_cast<std::uint8_t>(stream.back() ^ 1U);
  stream.push_back(kNakByte);
  TelegramReader reader(Sender::kDevice);
  const auto all = all_received(reader, stream, 5);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].kind, Kind::kNak);
  EXPECT_EQ(all[0].first_byte, stream.size() - 1);
}

TEST(Lms200Reader, LengthsThatNoTelegramHasAreNotWaitedFor) {
  for (const char* const header : {"02 80 00 00", "02 80 2D 03", "02 80 FF FF", "02 7F 03 00", "02 85 03 00"}) {
    Bytes stream = bytes_of(header);
    append(stream, device_telegram(bytes_of("A0 00 10")));
    TelegramReader reader(Sender::kDevice);
    EXPECT_EQ(payloads_of(all_received(reader, stream, 1)).size(), 1U) << header;
  }
}

TEST(Lms200Reader, EachAddressOfADeviceIsAccepted) {
  for (std::uint8_t address = kDeviceAddress; address <= kLastDeviceAddress; ++address) {
    Bytes telegram = bytes_of("02 80 03 00 A0 00 10");
    telegram[1] = address;
    const std::uint16_t crc = crc16(telegram);
    append(telegram, {static_cast<std::uint8_t>(crc & 0xFF), static_cast<std::uint8_t>(crc >> 8)});
    TelegramReader reader(Sender::kDevice);
    EXPECT_EQ(payloads_of(all_received(reader, telegram, 4)).size(), 1U);
  }
}

TEST(Lms200Reader, TheHostsTelegramsAreNotTakenForTheDevices) {
  const Bytes host = encode_telegram(Sender::kHost, bytes_of("20 24"));
  TelegramReader of_device(Sender::kDevice);
  EXPECT_TRUE(payloads_of(all_received(of_device, host, 4)).empty());
  TelegramReader of_host(Sender::kHost);
  EXPECT_EQ(payloads_of(all_received(of_host, host, 4)).size(), 1U);
}

TEST(Lms200Reader, AfterAClearTheStreamGoesOnFromItsIndex) {
  TelegramReader reader(Sender::kDevice);
  EXPECT_TRUE(all_received(reader, bytes_of("02 80 20"), 3).empty());
  reader.clear();
  EXPECT_FALSE(reader.partial());
  const auto all = all_received(reader, device_telegram(bytes_of("A0 00 10")), 4);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].first_byte, 3U);
}

}  // namespace
}  // namespace seeker::lms200
