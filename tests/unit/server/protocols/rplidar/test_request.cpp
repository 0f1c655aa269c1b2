#include "server/protocols/rplidar/request.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/core/rng.hpp"
#include "server/protocols/rplidar/request_reader.hpp"
#include "tests/support/random_bytes.hpp"

namespace seeker::rplidar {
namespace {

using ::testing::ElementsAre;
using Bytes = std::vector<std::uint8_t>;

TEST(RplidarRequest, TheVectorsOfTheManualAreWrittenByteForByte) {
  EXPECT_EQ(encode({Command::kStop, {}}), (Bytes{0xA5, 0x25}));
  EXPECT_EQ(encode({Command::kReset, {}}), (Bytes{0xA5, 0x40}));
  EXPECT_EQ(encode({Command::kScan, {}}), (Bytes{0xA5, 0x20}));
  EXPECT_EQ(encode({Command::kForceScan, {}}), (Bytes{0xA5, 0x21}));
  EXPECT_EQ(encode({Command::kGetInfo, {}}), (Bytes{0xA5, 0x50}));
  EXPECT_EQ(encode({Command::kGetHealth, {}}), (Bytes{0xA5, 0x52}));
  EXPECT_EQ(encode({Command::kGetSampleRate, {}}), (Bytes{0xA5, 0x59}));
  EXPECT_EQ(encode(express_scan(0)), (Bytes{0xA5, 0x82, 0x05, 0, 0, 0, 0, 0, 0x22}));
  EXPECT_EQ(encode(set_motor_pwm(660)), (Bytes{0xA5, 0xF0, 0x02, 0x94, 0x02, 0xC1}));
  EXPECT_EQ(encode(set_motor_pwm(0)), (Bytes{0xA5, 0xF0, 0x02, 0, 0, 0x57}));
  EXPECT_EQ(encode(get_acc_board_flag()), (Bytes{0xA5, 0xFF, 0x04, 0, 0, 0, 0, 0x5E}));
  EXPECT_EQ(encode(get_conf(ConfType::kTypicalMode)), (Bytes{0xA5, 0x84, 0x04, 0x7C, 0, 0, 0, 0x59}));
}

TEST(RplidarRequest, AQuestionForAModeCarriesItsNumber) {
  EXPECT_EQ(get_conf(ConfType::kSamplePeriod, 0x0102).payload, (Bytes{0x71, 0, 0, 0, 0x02, 0x01}));
}

TEST(RplidarRequestReader, ReadsARequestThatComesByteByByte) {
  RequestReader reader;
  std::vector<Request> requests;
  for (const std::uint8_t byte : encode(set_motor_pwm(660))) {
    EXPECT_TRUE(requests.empty());
    requests = reader.read(std::span(&byte, 1));
  }
  EXPECT_THAT(requests, ElementsAre(set_motor_pwm(660)));
  EXPECT_FALSE(reader.waits());
}

TEST(RplidarRequestReader, ALostByteCostsOneRequest) {
  Bytes bytes = encode(set_motor_pwm(660));
  bytes.erase(bytes.begin() + 3);
  RequestReader reader;
  EXPECT_TRUE(reader.read(bytes).empty());
  EXPECT_THAT(reader.read(encode({Command::kStop, {}})), ElementsAre(Request{Command::kStop, {}}));
}

TEST(RplidarRequestReader, ARequestThatIsNeverCompletedIsGivenUp) {
  RequestReader reader;
  EXPECT_TRUE(reader.read(Bytes{0xA5, 0xF0, 0x20, 0xA5, 0x25}).empty());
  EXPECT_TRUE(reader.waits());
  EXPECT_THAT(reader.give_up(), ElementsAre(Request{Command::kStop, {}}));
  EXPECT_FALSE(reader.waits());
}

TEST(RplidarRequestReader, AnImpossibleSizeIsNotWaitedFor) {
  RequestReader reader;
  EXPECT_THAT(reader.read(Bytes{0xA5, 0xF0, 0xFF, 0xA5, 0x50}), ElementsAre(Request{Command::kGetInfo, {}}));
}

Request random_request(Rng& rng) {
  const auto command = static_cast<std::uint8_t>(rng.below(256));
  Request request{static_cast<Command>(command == kRequestStart ? 0x25 : command), {}};
  if ((command & kPayloadBit) != 0 && command != kRequestStart) {
    request.payload = seeker::testing::random_bytes(rng, rng.below(kMaxRequestPayload + 1));
  }
  return request;
}

RC_GTEST_PROP(RplidarRequestReader, AnyCutAndAnyTextBetweenGivesTheSameRequests, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  std::vector<Request> sent;
  Bytes bytes;
  for (std::size_t k = 0; k < 20; ++k) {
    sent.push_back(random_request(rng));
    const Bytes request = encode(sent.back());
    bytes.insert(bytes.end(), request.begin(), request.end());
    for (std::uint64_t text = rng.below(10); text > 0; --text) {
      bytes.push_back(static_cast<std::uint8_t>(rng.below(128)));  // holds no start
    }
  }
  RequestReader reader;
  std::vector<Request> read;
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t piece = std::min<std::size_t>(1 + rng.below(20), bytes.size() - at);
    for (const Request& request : reader.read(std::span(bytes).subspan(at, piece))) {
      read.push_back(request);
    }
    at += piece;
  }
  RC_ASSERT(read == sent);
}

}  // namespace
}  // namespace seeker::rplidar
