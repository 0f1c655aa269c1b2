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
  deck.hooks.on_mission_started = [&](const api::MissionRequest& request) {
    journal.push_back(request.id);
    EXPECT_TRUE(deck.mission_events.empty()) << "its events are journaled as those of a mission that is known";
  };
  ASSERT_TRUE(deck.missions.start(go_to("first"), "tester"));
  EXPECT_TRUE(deck.motion.authority().armed());
  EXPECT_EQ(journal, (std::vector<api::MissionId>{"first"}));
  EXPECT_EQ(deck.mission_events, (std::vector<std::string>{"mission-started"}));
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

TEST(MissionControl, NoMissionBeginsWhileTheDiskTakesNothing) {
  FakeDeck deck;
  deck.missions.offer_unfinished(go_to("cut"));
  deck.diagnostics.raise(kJournalFailed, "journal", "no space is left", "free some", api::Severity::kWarning);
  const Result<api::MissionId> refused = deck.missions.start(go_to("first"), "tester");
  EXPECT_EQ(refused.error().code, Errc::kNotReady);
  EXPECT_NE(refused.error().message.find("no space is left; free some"), std::string::npos) << refused.error().message;
  EXPECT_FALSE(deck.missions.command(api::MissionCommand::kResume, "tester"));
  deck.diagnostics.clear(kJournalFailed);
  EXPECT_TRUE(deck.missions.command(api::MissionCommand::kResume, "tester")) << "it is still offered";
}

TEST(MissionControl, AskedForAgainAMissionThatRunsGoesOnAndIsJournaledOnce) {
  FakeDeck deck;
  int journaled = 0;
  int dropped = 0;
  deck.hooks.on_mission_started = [&](const api::MissionRequest& /*request*/) { ++journaled; };
  ASSERT_TRUE(deck.missions.start(go_to("first"), "tester"));
  deck.hooks.on_checkpoints_void = [&] { ++dropped; };
  deck.missions.checkpoints().adopt();
  deck.diagnostics.raise(kJournalFailed, "journal", "no space is left", "free some", api::Severity::kWarning);
  EXPECT_EQ(deck.missions.start(go_to("first"), "tester").value(), "first");
  EXPECT_TRUE(deck.missions.runs("first"));
  EXPECT_EQ(journaled, 1);
  EXPECT_EQ(dropped, 0) << "what is kept of it stays";
}

TEST(MissionControl, AMissionThatCouldNotBeKeptEndsWithTheCauseAndNoOther) {
  FakeDeck deck;
  ASSERT_TRUE(deck.missions.start(go_to("first"), "tester"));
  deck.missions.end_unkept("another", {Errc::kIo, "no space is left; free some"});
  EXPECT_TRUE(deck.missions.runs("first"));
  deck.missions.end_unkept("first", {Errc::kIo, "no space is left; free some"});
  EXPECT_FALSE(deck.executor.present());
  EXPECT_EQ(deck.executor.last()->end->outcome, api::Outcome::kFault);
  EXPECT_EQ(deck.executor.last()->end->remedy, "free some");
  EXPECT_FALSE(deck.motion.authority().armed());
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
