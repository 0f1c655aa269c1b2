// What a mission does while the client that started it is silent: each action of a link policy, and the countdown.

#include <algorithm>

#include <gmock/gmock.h>

#include "tests/unit/server/app/missions/mission_fixture.hpp"

namespace seeker::app {
namespace {

using std::chrono::seconds;
using ::testing::HasSubstr;

class LinkPolicies : public MissionFixture {
 protected:
  /// A mission of anna with this policy, who falls silent now.
  void lose_anna(const std::string& steps) {
    api::MissionRequest mission = request("one");
    mission.link_steps = api::parse_link_steps(steps).value();
    ASSERT_TRUE(executor.start(mission, "anna", situation));
    script->next.command = {0.3, 0.0};
    executor.client_silent("anna", wall);
  }
  /// What it does when so much more silence has passed.
  Decision after(int s) {
    wall += seconds(s);
    return executor.step(situation, nullptr, wall);
  }
  [[nodiscard]] std::size_t count(const std::string& kind) const {
    return static_cast<std::size_t>(
        std::count_if(events.begin(), events.end(), [&](const api::Event& event) { return event.kind == kind; }));
  }
  [[nodiscard]] bool moves(int s) { return after(s).command.v_m_s > 0.0; }
};

TEST_F(LinkPolicies, EventIsToldOnceAndTheMissionGoesOn) {
  lose_anna("2:event");
  EXPECT_TRUE(moves(1));
  EXPECT_EQ(count("link-policy"), 0U);
  EXPECT_TRUE(moves(1));
  EXPECT_TRUE(moves(60));
  EXPECT_EQ(count("link-policy"), 1U);
}

TEST_F(LinkPolicies, PauseHoldsTheMissionUntilSomebodyResumesIt) {
  lose_anna("5:pause");
  EXPECT_TRUE(moves(4));
  EXPECT_FALSE(moves(1));
  EXPECT_EQ(executor.last()->state, api::MissionState::kPaused);
  executor.client_back("anna", situation.now);
  EXPECT_FALSE(moves(1)) << "who comes back decides what follows";
  EXPECT_EQ(count("link-back"), 1U);
  ASSERT_TRUE(executor.command(api::MissionCommand::kResume, situation.now));
  EXPECT_TRUE(moves(1));
}

TEST_F(LinkPolicies, StopEndsTheMission) {
  lose_anna("5:stop");
  EXPECT_TRUE(moves(4));
  EXPECT_FALSE(moves(1));
  EXPECT_EQ(end().outcome, api::Outcome::kLinkLost);
  EXPECT_THAT(end().cause, HasSubstr("'anna'"));
}

TEST_F(LinkPolicies, FinishStepEndsTheMissionWithItsStep) {
  lose_anna("5:finish-step");
  EXPECT_TRUE(moves(5));
  script->next.step_done = true;
  static_cast<void>(after(1));
  EXPECT_EQ(end().outcome, api::Outcome::kLinkLost);
}

TEST_F(LinkPolicies, ContinueGoesOnWhateverComes) {
  lose_anna("5:continue");
  EXPECT_TRUE(moves(5));
  EXPECT_TRUE(moves(10'000));
  ASSERT_TRUE(executor.link_countdown());
  EXPECT_FALSE(executor.link_countdown()->next);
}

TEST_F(LinkPolicies, ReturnDrivesTheTravelledPathBack) {
  api::MissionRequest mission = request("one");
  mission.link_steps = api::parse_link_steps("5:return").value();
  ASSERT_TRUE(executor.start(mission, "anna", situation));
  for (const Point2& place : {Point2(0, 0), Point2(2, 0), Point2(4, 0), Point2(4, 3)}) {
    situation.pose.map_T_base = Pose2(place.x(), place.y(), 0.0);
    static_cast<void>(tick());
  }
  executor.client_silent("anna", wall);
  static_cast<void>(after(5));
  ASSERT_EQ(made.back(), "return");
  EXPECT_EQ(std::get<api::ReturnMission>(made_last).along, (std::vector<Point2>{{4, 0}, {2, 0}, {0, 0}}));
  script->next.end =
      api::MissionEnd{.outcome = api::Outcome::kComplete, .cause = "home", .remedy = "", .unreachable = {}};
  static_cast<void>(after(1));
  EXPECT_EQ(end().outcome, api::Outcome::kLinkLost);
}

TEST_F(LinkPolicies, AListIsCarriedOutInItsOrderAndAPauseOfItsOwnEndsWithTheNextEntry) {
  lose_anna("2:event,5:pause,30:return");
  EXPECT_TRUE(moves(2));
  EXPECT_FALSE(moves(3));
  EXPECT_FALSE(moves(24));
  EXPECT_TRUE(moves(1)) << "it drives back";
  EXPECT_EQ(made.back(), "return");
  EXPECT_EQ(count("link-policy"), 3U);
}

TEST_F(LinkPolicies, EntriesThatAreDueTogetherAreCarriedOutTogether) {
  lose_anna("2:event,5:pause,30:stop");
  static_cast<void>(after(31));
  EXPECT_EQ(count("link-policy"), 3U);
  EXPECT_EQ(end().outcome, api::Outcome::kLinkLost);
}

TEST_F(LinkPolicies, WhatAPersonHasPausedNoPolicyResumes) {
  lose_anna("5:pause,30:return");
  static_cast<void>(after(5));
  executor.pause(situation.now, "emergency stop");
  EXPECT_FALSE(moves(25));
  EXPECT_EQ(made.back(), "return") << "it would drive back";
  EXPECT_EQ(executor.last()->state, api::MissionState::kPaused);
}

TEST_F(LinkPolicies, CountdownNamesTheNextEntry) {
  lose_anna("2:event,5:pause,30:return");
  ASSERT_TRUE(executor.link_countdown());
  static_cast<void>(after(3));
  const api::LinkCountdown countdown = executor.link_countdown().value();
  EXPECT_EQ(countdown.silent, Duration(seconds(3)));
  ASSERT_TRUE(countdown.next);
  EXPECT_EQ(countdown.next->action, api::LinkAction::kPause);
  EXPECT_EQ(countdown.left, Duration(seconds(2)));
  executor.client_back("anna", situation.now);
  EXPECT_FALSE(executor.link_countdown());
}

TEST_F(LinkPolicies, EachSilenceCountsFromItsBeginning) {
  lose_anna("2:event,5:stop");
  EXPECT_TRUE(moves(4));
  executor.client_silent("anna", wall);  // told again, as when its connection breaks at last
  EXPECT_EQ(executor.link_countdown()->silent, Duration(seconds(4)));
  executor.client_back("anna", situation.now);
  executor.client_silent("anna", wall);
  EXPECT_TRUE(moves(4));
  EXPECT_EQ(count("link-policy"), 2U) << "the event of each silence";
  EXPECT_FALSE(moves(1));
}

TEST_F(LinkPolicies, SilenceOfOthersDoesNotMatter) {
  lose_anna("5:stop");
  executor.client_back("anna", situation.now);
  executor.client_silent("ben", wall);
  EXPECT_TRUE(moves(60));
}

TEST_F(LinkPolicies, MissionTellsThePolicyThatApplies) {
  ASSERT_TRUE(executor.start(request("short", api::LinkPolicy::kReturn), "anna", situation));
  EXPECT_EQ(executor.last()->link_steps, (api::LinkSteps{{seconds(5), api::LinkAction::kReturn}}));
}

}  // namespace
}  // namespace seeker::app
