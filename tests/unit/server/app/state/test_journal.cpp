#include "server/app/state/journal.hpp"

#include <future>

#include <gtest/gtest.h>

#include "tests/unit/server/store/temporary_folder.hpp"

namespace seeker::app {
namespace {

api::MissionRequest exploration(const std::string& id) {
  api::MissionRequest request;
  request.id = id;
  request.task = api::ExploreMission{};
  return request;
}

/// The id that a program which is started now could resume. It is killed at once.
std::string unfinished_in(const std::filesystem::path& folder) {
  const auto journal = Journal::open(folder).value();
  return journal->unfinished() ? journal->unfinished()->id : "";
}

std::optional<store::MissionEndRecord> end_of(const std::filesystem::path& folder, const std::string& id) {
  return store::Store::open(folder)->mission(id).value().value().end;
}

TEST(Journal, MissionThatWasCutOffIsOfferedUntilItIsResumedOverAnyNumberOfKills) {
  const testing::TemporaryFolder folder;
  Journal::open(folder.path()).value()->mission_started(exploration("round"), RobotTime{});
  EXPECT_EQ(unfinished_in(folder.path()), "round");
  EXPECT_EQ(unfinished_in(folder.path()), "round") << "killed again before anybody has resumed it";
  EXPECT_FALSE(end_of(folder.path(), "round"));
  Journal::open(folder.path()).value()->mission_started(exploration("round"), RobotTime{});
  EXPECT_EQ(unfinished_in(folder.path()), "round") << "and after it was resumed";
  api::MissionStatus status;
  status.id = "round";
  status.end = api::MissionEnd{api::Outcome::kComplete, "all is mapped", "", {}};
  {
    const auto journal = Journal::open(folder.path()).value();
    journal->mission_started(exploration("round"), RobotTime{});
    journal->mission(status);
  }
  EXPECT_EQ(unfinished_in(folder.path()), "");
  EXPECT_EQ(end_of(folder.path(), "round")->outcome, "COMPLETE");
}

TEST(Journal, EmergencyStopIsKeptWhenThatIsTold) {
  const testing::TemporaryFolder folder;
  const auto keep = [&](bool engaged) {
    const auto journal = Journal::open(folder.path()).value();
    std::promise<Status> kept;
    journal->keep_estop(engaged, [&](const Status& status) { kept.set_value(status); });
    const Status told = kept.get_future().get();
    EXPECT_TRUE(told) << told.error().message;
  };
  EXPECT_FALSE(Journal::open(folder.path()).value()->estop()) << "a new robot is not stopped";
  keep(true);
  EXPECT_TRUE(Journal::open(folder.path()).value()->estop());
  EXPECT_TRUE(Journal::open(folder.path()).value()->estop()) << "over any number of restarts";
  keep(false);
  EXPECT_FALSE(Journal::open(folder.path()).value()->estop());
}

TEST(Journal, AnotherMissionClosesTheRecordOfTheOneThatWasCutOff) {
  const testing::TemporaryFolder folder;
  Journal::open(folder.path()).value()->mission_started(exploration("round"), RobotTime{});
  EXPECT_EQ(unfinished_in(folder.path()), "round");
  Journal::open(folder.path()).value()->mission_started(exploration("another"), RobotTime{});
  EXPECT_EQ(end_of(folder.path(), "round")->outcome, "FAULT");
  EXPECT_EQ(end_of(folder.path(), "round")->cause, "the program ended");
  EXPECT_EQ(unfinished_in(folder.path()), "another");
}

TEST(Journal, WhatWasFoundIsKeptWithTheMissionThatHasFoundIt) {
  const testing::TemporaryFolder folder;
  api::Detection bag;
  bag.id = 4;
  bag.target = "bag";
  bag.mission = "earlier";
  {
    const auto journal = Journal::open(folder.path()).value();
    journal->mission_started(exploration("round"), RobotTime{});
    journal->detection(bag);
  }
  EXPECT_EQ(Journal::open(folder.path()).value()->highest_detection_id(), 4U);
  const auto kept = store::Store::open(folder.path())->detections("earlier").value();
  ASSERT_EQ(kept.size(), 1U) << "the map it lies in outlives its mission, and it is told again";
  EXPECT_EQ(kept[0].target, "bag");
}

/// Opens the journal, as a program that starts does, has one mission begin or go on, and one event happen.
void begin_and_tell(const std::filesystem::path& folder, const std::string& mission, const std::string& text) {
  const auto journal = Journal::open(folder).value();
  journal->mission_started(exploration(mission), RobotTime{});
  api::Event event;
  event.sequence = 1;  // a mission counts from one again
  event.mission = mission;
  event.text = text;
  journal->event(event);
}

TEST(Journal, WhatHappenedBeforeAKillStaysWhenTheMissionGoesOn) {
  const testing::TemporaryFolder folder;
  begin_and_tell(folder.path(), "round", "before the kill");
  begin_and_tell(folder.path(), "round", "after it");
  const auto events = store::Store::open(folder.path())->events("round").value();
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].text, "before the kill");
  EXPECT_EQ(events[1].text, "after it");
}

TEST(Journal, OnlyTheFirstErrorIsToldSinceThoseAfterItHideTheCause) {
  const testing::TemporaryFolder folder;
  std::vector<std::string> told;
  {
    const auto journal = Journal::open(folder.path()).value();
    journal->set_watch(
        {.failing = {}, .writes_again = {}, .lost = [&](const Error& error) { told.push_back(error.message); }});
    api::MissionStatus status;
    status.id = "never-begun";
    status.end = api::MissionEnd{api::Outcome::kComplete, "", "", {}};
    journal->mission(status);
    api::Event event;
    event.text = std::string(store::kMaxText_bytes + 1, 'x');
    journal->event(event);
  }
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told.front().find("never-begun"), std::string::npos) << told.front();
}

TEST(Journal, DamagedOneIsToldAndTheRobotComesUpStopped) {
  const testing::TemporaryFolder folder;
  Journal::open(folder.path()).value()->mission_started(exploration("round"), RobotTime{});
  std::filesystem::resize_file(folder.path() / "seeker.db", 5000);
  {
    const auto journal = Journal::open(folder.path()).value();
    EXPECT_NE(journal->lost().find("seeker.db.damaged-1"), std::string::npos) << journal->lost();
    EXPECT_TRUE(journal->estop()) << "nobody knows whether it was latched";
    EXPECT_FALSE(journal->unfinished());
  }
  const auto again = Journal::open(folder.path()).value();
  EXPECT_EQ(again->lost(), "");
  EXPECT_TRUE(again->estop()) << "until somebody releases it";
}

TEST(Journal, RequestThatCannotBeReadIsTold) {
  const testing::TemporaryFolder folder;
  {
    store::Store store = store::Store::open(folder.path()).value();
    ASSERT_TRUE(store.begin_mission({"round", "explore", store::Blob{0xff, 0xff}, 0, std::nullopt}));
  }
  EXPECT_NE(Journal::open(folder.path()).value()->lost().find("'round'"), std::string::npos);
  EXPECT_EQ(end_of(folder.path(), "round")->outcome, "FAULT");
}

}  // namespace
}  // namespace seeker::app
