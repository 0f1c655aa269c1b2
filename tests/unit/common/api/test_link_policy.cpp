#include "common/api/link_policy.hpp"

#include <gmock/gmock.h>

namespace seeker::api {
namespace {

using std::chrono::seconds;
using ::testing::HasSubstr;

TEST(LinkPolicy, ListIsRead) {
  const Result<LinkSteps> steps = parse_link_steps("2:event,5:pause,30.5:return");
  ASSERT_TRUE(steps) << steps.error().message;
  EXPECT_EQ(*steps, (LinkSteps{{seconds(2), LinkAction::kEvent},
                               {seconds(5), LinkAction::kPause},
                               {std::chrono::milliseconds(30'500), LinkAction::kReturn}}));
}

TEST(LinkPolicy, WhatIsNoListIsRefusedWithTheEntry) {
  for (const char* text : {"", "pause", "5", "5:", ":pause", "5:jump", "5:pause,", "0:stop", "-1:stop", "nan:stop",
                           "1e9:stop", "5:pause 6:stop"}) {
    const Result<LinkSteps> steps = parse_link_steps(text);
    ASSERT_FALSE(steps) << text;
    EXPECT_EQ(steps.error().code, Errc::kInvalidArgument) << text;
    EXPECT_THAT(steps.error().message, HasSubstr("5:pause,30:return"));
  }
}

TEST(LinkPolicy, TimesRiseAndNothingFollowsAnEnd) {
  EXPECT_FALSE(parse_link_steps("5:event,5:pause"));
  EXPECT_FALSE(parse_link_steps("5:pause,2:event"));
  EXPECT_THAT(parse_link_steps("5:stop,6:event").error().message, HasSubstr("'stop'"));
  EXPECT_FALSE(parse_link_steps("5:continue,6:return"));
  EXPECT_TRUE(parse_link_steps("5:finish-step,60:stop")) << "a step may take too long";
}

TEST(LinkPolicy, AListHasABound) {
  LinkSteps steps;
  for (std::size_t i = 0; i < kMaxLinkSteps; ++i) {
    steps.push_back({seconds(i + 1), LinkAction::kEvent});
  }
  EXPECT_TRUE(validate(steps));
  steps.push_back({seconds(100), LinkAction::kStop});
  EXPECT_EQ(validate(steps).error().code, Errc::kTooLarge);
}

TEST(LinkPolicy, ShortFormIsAListOfOneEntry) {
  EXPECT_EQ(link_steps_of(LinkPolicy::kReturn, seconds(5)), (LinkSteps{{seconds(5), LinkAction::kReturn}}));
  EXPECT_EQ(link_steps_of(LinkPolicy::kFinishStep, seconds(3)), (LinkSteps{{seconds(3), LinkAction::kFinishStep}}));
}

}  // namespace
}  // namespace seeker::api
