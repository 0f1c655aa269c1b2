#include "common/wire/stream_sender.hpp"

#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace seeker::wire {
namespace {

namespace pb = ::seeker::v1;
using std::chrono::milliseconds;

WallTime at(int ms) { return WallTime(milliseconds(1'000'000 + ms)); }

class SenderTest : public ::testing::Test {
 protected:
  SenderTest() : sender_(backlogs_, kRun) {}
  static constexpr std::uint64_t kRun = 42;

  void push(std::uint64_t sequence) {
    backlogs_[static_cast<std::size_t>(api::Topic::kEvent)].push(
        sequence, std::make_shared<const std::string>("e" + std::to_string(sequence)));
  }
  pb::TopicReply subscribe(std::uint64_t after, std::uint64_t run) {
    return sender_.subscribe(1, {{{api::Topic::kEvent, 0.0, after}, run}}).front();
  }
  std::vector<std::string> drain(int ms = 0) {
    std::vector<std::string> out;
    while (const auto frame = sender_.next(at(ms))) {
      out.push_back(*frame->body);
    }
    return out;
  }
  Backlogs backlogs_{Backlog(3, 1000), Backlog(3, 1000), Backlog(3, 1000), Backlog(3, 1000),
                     Backlog(3, 1000), Backlog(3, 1000), Backlog(3, 1000), Backlog(3, 1000),
                     Backlog(3, 1000), Backlog(3, 1000), Backlog(3, 1000), Backlog(3, 1000)};
  StreamSender sender_;
};

using Texts = std::vector<std::string>;

TEST_F(SenderTest, BeginsNowWithoutAPosition) {
  push(1);
  EXPECT_EQ(subscribe(0, 0).start(), pb::TopicReply::START_NOW);
  push(2);
  EXPECT_EQ(drain(), (Texts{"e2"}));
}

TEST_F(SenderTest, ResumesAfterAPositionOfThisRun) {
  for (const std::uint64_t k : {1, 2, 3}) {
    push(k);
  }
  const auto reply = subscribe(1, kRun);
  EXPECT_EQ(reply.start(), pb::TopicReply::START_RESUMED);
  EXPECT_EQ(drain(), (Texts{"e2", "e3"}));
}

TEST_F(SenderTest, ResumesFromTheVeryFirstItemOfThisRun) {
  EXPECT_EQ(subscribe(0, kRun).start(), pb::TopicReply::START_RESUMED);
  push(1);
  EXPECT_EQ(drain(), (Texts{"e1"}));
}

TEST_F(SenderTest, TellsOfAGap) {
  for (std::uint64_t k = 1; k <= 6; ++k) {
    push(k);
  }
  const auto reply = subscribe(1, kRun);
  EXPECT_EQ(reply.start(), pb::TopicReply::START_GAP);
  EXPECT_EQ(reply.position(), 3U);
  EXPECT_FALSE(sender_.overrun());
  EXPECT_EQ(drain(), (Texts{"e4", "e5", "e6"}));
}

TEST_F(SenderTest, TellsOfAnotherRun) {
  push(1);
  EXPECT_EQ(subscribe(500, kRun + 1).start(), pb::TopicReply::START_OTHER_RUN);
  EXPECT_EQ(drain(), (Texts{"e1"}));
  EXPECT_EQ(subscribe(500, 0).start(), pb::TopicReply::START_OTHER_RUN);
}

TEST_F(SenderTest, AReceiverThatLagsBehindTheBacklogIsNoticed) {
  push(1);
  (void)subscribe(0, 0);
  for (std::uint64_t k = 2; k <= 4; ++k) {
    push(k);
  }
  EXPECT_FALSE(sender_.overrun());
  push(5);
  EXPECT_EQ(sender_.overrun(), api::Topic::kEvent);
}

TEST_F(SenderTest, ASourceThatStartedEarlierIsNoOverrun) {
  (void)subscribe(0, 0);
  push(1000);
  EXPECT_FALSE(sender_.overrun());
  EXPECT_EQ(drain(), (Texts{"e1000"}));
}

TEST_F(SenderTest, LatestKeepsTheNewestWithinItsRate) {
  (void)sender_.subscribe(1, {{{api::Topic::kStatus, 10.0, 0}, 0}});
  const auto body = [](const char* text) { return std::make_shared<const std::string>(text); };
  sender_.offer(api::Topic::kStatus, 1, body("a"));
  EXPECT_EQ(drain(0), (Texts{"a"}));
  sender_.offer(api::Topic::kStatus, 2, body("b"));
  sender_.offer(api::Topic::kStatus, 5, body("c"));
  EXPECT_EQ(drain(50), (Texts{}));
  EXPECT_EQ(sender_.next_due(), at(100));
  const auto frame = sender_.next(at(100));
  ASSERT_TRUE(frame);
  EXPECT_EQ(*frame->body, "c");
  pb::StreamUpdate tail;
  ASSERT_TRUE(tail.ParseFromString(frame->tail));
  EXPECT_EQ(tail.dropped(), 3U);  // b, and two that were overtaken before
}

TEST_F(SenderTest, CountsWhatSlowClientsMissByTopic) {
  DropCounts counts{};
  StreamSender sender(backlogs_, kRun, &counts);
  (void)sender.subscribe(1, {{{api::Topic::kStatus, 0.0, 0}, 0}});
  const auto body = std::make_shared<const std::string>("a");
  sender.offer(api::Topic::kStatus, 1, body);
  ASSERT_TRUE(sender.next(at(0)));
  sender.offer(api::Topic::kStatus, 5, body);
  ASSERT_TRUE(sender.next(at(1)));
  EXPECT_EQ(counts[static_cast<std::size_t>(api::Topic::kStatus)], 3U);
  EXPECT_EQ(counts[static_cast<std::size_t>(api::Topic::kScan)], 0U);
}

TEST_F(SenderTest, ReliableAndLatestTakeTurns) {
  (void)sender_.subscribe(1, {{{api::Topic::kEvent, 0.0, 0}, kRun}, {{api::Topic::kScan, 0.0, 0}, 0}});
  push(1);
  push(2);
  sender_.offer(api::Topic::kScan, 1, std::make_shared<const std::string>("s"));
  EXPECT_EQ(drain(), (Texts{"e1", "s", "e2"}));
}

TEST_F(SenderTest, StatusGoesBeforeAnImageThatWaits) {
  (void)sender_.subscribe(1, {{{api::Topic::kStatus, 0.0, 0}, 0}, {{api::Topic::kImage, 0.0, 0}, 0}});
  const auto body = [](const char* text) { return std::make_shared<const std::string>(text); };
  sender_.offer(api::Topic::kStatus, 1, body("s1"));
  EXPECT_EQ(drain(), Texts{"s1"}) << "the image would be next in turn";
  sender_.offer(api::Topic::kImage, 1, body("i1"));
  sender_.offer(api::Topic::kStatus, 2, body("s2"));
  EXPECT_EQ(drain(), (Texts{"s2", "i1"}));
}

TEST_F(SenderTest, StatusThatIsAlwaysNewDoesNotStarveTheOthers) {
  (void)sender_.subscribe(1, {{{api::Topic::kStatus, 0.0, 0}, 0}, {{api::Topic::kEvent, 0.0, 0}, kRun}});
  push(1);
  push(2);
  std::size_t events = 0;
  for (std::uint64_t k = 1; k <= 4; ++k) {
    sender_.offer(api::Topic::kStatus, k, std::make_shared<const std::string>("s"));
    const auto frame = sender_.next(at(0));
    ASSERT_TRUE(frame);
    events += *frame->body == "s" ? 0 : 1;
  }
  EXPECT_EQ(events, 2U);
}

}  // namespace
}  // namespace seeker::wire
