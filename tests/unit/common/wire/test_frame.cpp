#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/wire/frame.hpp"

namespace seeker::wire {
namespace {

std::string bytes_of(const std::string& payload) {
  const OutFrame frame = make_frame(payload);
  return frame.head + *frame.body + frame.tail;
}

RC_GTEST_PROP(Frame, AnyPayloadsCutIntoAnyChunksComeOutUnchangedAndInOrder, (std::vector<std::string> payloads)) {
  std::string stream;
  for (const std::string& payload : payloads) {
    stream += bytes_of(payload);
  }
  FrameDecoder decoder;
  std::vector<std::string> out;
  for (std::size_t at = 0; at < stream.size();) {
    const auto n = *rc::gen::inRange<std::size_t>(1, 40);
    RC_ASSERT(decoder.feed(std::string_view(stream).substr(at, n)).has_value());
    at += n;
    while (const auto payload = decoder.next()) {
      out.emplace_back(*payload);
    }
  }
  RC_ASSERT(out == payloads);
  RC_ASSERT(decoder.pending_bytes() == 0U);
}

TEST(Frame, TheLengthIsBigEndian) {
  EXPECT_EQ(bytes_of(std::string(258, 'x')).substr(0, 4), std::string("\0\0\1\2", 4));
}

TEST(Frame, AnAnnouncedSizeAboveTheLimitIsRefusedAtOnce) {
  FrameDecoder decoder(10);
  const Status fed = decoder.feed(std::string("\0\0\0\x0b", 4));
  ASSERT_FALSE(fed);
  EXPECT_EQ(fed.error().code, Errc::kTooLarge);
  EXPECT_FALSE(decoder.next());
  EXPECT_FALSE(decoder.feed("x"));
}

TEST(Frame, WhatCameBeforeAnOversizedFrameIsStillGood) {
  FrameDecoder decoder(10);
  EXPECT_FALSE(decoder.feed(bytes_of("good") + std::string("\xff\xff\xff\xff")));
  EXPECT_EQ(decoder.next(), "good");
  EXPECT_FALSE(decoder.next());
}

TEST(Frame, ExactlyTheLimitIsAllowed) {
  FrameDecoder decoder(10);
  ASSERT_TRUE(decoder.feed(bytes_of("0123456789")));
  EXPECT_EQ(decoder.next(), "0123456789");
}

}  // namespace
}  // namespace seeker::wire
