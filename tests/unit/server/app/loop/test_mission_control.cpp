// What must hold before a mission may begin, and what stopping and resuming do.

#include <gtest/gtest.h>

#include "tests/unit/server/app/loop/fake_deck.hpp"

namespace seeker::app {
namespace {

using testing::FakeDeck;
using testing::go_to;

TEST(MissionControl, AMissionArmsTheRobotAndIsReportedToTheJournal) {
  FakeDeck deck;
  std::vector<api::MissionId> journal;
  deck.hooks.on_mission_started = [&](const api::MissionRequest& request) { journal.push_back(request.id); };
  ASSERT_TRUE(deck.missions.start(go_to("first"), "tester"));
  EXPECT_TRUE(deck.motion.authority().armed());
  EXPECT_EQ(journal, (std::vector<api::MissionId>{"first"}));
}

TEST(MissionControl, RefusesWhileTheEmergencyStopIsLatched) {
  FakeDeck deck;
  deck.motion.set_estop(true);
  const Result<api::MissionId> refused = deck.missions.start(go_to("first"), "tester");
  EXPECT_EQ(refused.error().code, Errc::kRefused);
  EXPECT_NE(refused.error().message.find("seeker estop --release"), std::string::npos);
}

TEST(MissionControl, RefusesWhileSomebodyElseHoldsTheLease) {
  FakeDeck deck;
  ASSERT_TRUE(deck.motion.authority().command_lease({"other"}, {api::LeaseAction::kAcquire, false}, {}));
  EXPECT_EQ(deck.missions.start(go_to("first"), "tester").error().code, Errc::kRefused);
  EXPECT_TRUE(deck.missions.start(go_to("first"), "other"));
}

TEST(MissionControl, RefusesWhileTheWorldIsAway) {
  FakeDeck deck;
  deck.clock->link = fail(Errc::kNotReady, "the link is cut");
  EXPECT_EQ(deck.missions.start(go_to("first"), "tester").error().code, Errc::kNotReady);
}

TEST(MissionControl, ResumeStartsTheMissionThatACrashCutOff) {
  FakeDeck deck;
  EXPECT_FALSE(deck.missions.command(api::MissionCommand::kResume, "tester"));
  deck.missions.offer_unfinished(go_to("cut"));
  ASSERT_TRUE(deck.missions.command(api::MissionCommand::kResume, "tester"));
  EXPECT_EQ(deck.executor.request()->id, "cut");
  EXPECT_FALSE(deck.missions.resumption().unfinished());
}

TEST(MissionControl, AMissionThatBuildsNoMapHasNoCheckpointToResume) {
  FakeDeck deck;
  deck.missions.offer_unfinished(go_to("cut"));
  EXPECT_FALSE(deck.missions.checkpoint_to_resume());
  EXPECT_FALSE(deck.missions.map_waits_for_resume());
}

TEST(MissionControl, StoppingEndsTheMission) {
  FakeDeck deck;
  ASSERT_TRUE(deck.missions.start(go_to("first"), "tester"));
  deck.missions.stop();
  EXPECT_FALSE(deck.executor.present());
  EXPECT_EQ(deck.executor.last()->end->outcome, api::Outcome::kOperator);
}

TEST(MapCommands, TheMapMayNotChangeUnderAMission) {
  FakeDeck deck;
  EXPECT_TRUE(deck.maps.may_change());
  ASSERT_TRUE(deck.missions.start(go_to("first"), "tester"));
  EXPECT_EQ(deck.maps.may_change().error().code, Errc::kBusy);
}

TEST(MapCommands, TheMapMayNotChangeWhileTheRobotMoves) {
  FakeDeck deck;
  deck.base->next = testing::odometry_at(deck.clock->time, {}, {0.3, 0.0});
  deck.tick();
  EXPECT_EQ(deck.maps.may_change().error().code, Errc::kRefused);
}

TEST(MapCommands, ARobotWithoutAMapOfSegmentsHasNothingToSave) {
  FakeDeck deck;
  EXPECT_EQ(deck.maps.to_save("office").error().code, Errc::kNotReady);
}

}  // namespace
}  // namespace seeker::app
