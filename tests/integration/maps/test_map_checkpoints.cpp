// The map of a mission that builds one: kept while it runs, loaded again when a crash has cut the mission off.

#include <algorithm>

#include <gtest/gtest.h>

#include "server/app/device_factory.hpp"
#include "server/app/tracker_estimator.hpp"
#include "tests/support/data.hpp"
#include "tests/support/maps/fake_map_tracker.hpp"
#include "tests/support/maps/random_map.hpp"

namespace seeker::testing {
namespace {

/// Stands still for ever.
class Standing final : public app::Behaviour {
 public:
  app::Decision step(const app::Situation& /*situation*/) override { return {}; }
};

api::MissionRequest exploration() {
  api::MissionRequest request;
  request.id = "look-round";
  request.task = api::ExploreMission{};
  return request;
}

class MapCheckpoints : public ::testing::Test {
 protected:
  MapCheckpoints() {
    const app::RobotOptions options = app::load_robot_options(source_file("config/robots/sim.yaml")).value();
    app::Assembly assembly = app::assemble(options).value();
    assembly.parts.estimator = std::make_unique<app::TrackerEstimator>(std::make_unique<FakeMapTracker>(state));
    assembly.parts.behaviours = [](const api::MissionTask&, const app::Situation&) {
      return Result<std::unique_ptr<app::Behaviour>>(std::make_unique<Standing>());
    };
    loop = std::make_unique<app::RobotLoop>(options.loop, std::move(assembly.parts), hub);
    loop->on_event = [this](const api::Event& event) { events.push_back(event); };
    loop->on_checkpoint = [this](const api::MissionId& mission, const app::LoopMap& map) {
      kept.push_back(mission);
      EXPECT_EQ(map.map.segments.size(), state->map.segments.size());
    };
    loop->on_checkpoints_void = [this] { ++dropped; };
    loop->start();
    state->map = room_map();
    state->changed();
  }

  void ticks(int count) {
    for (int k = 0; k < count; ++k) {
      wall += std::chrono::milliseconds(100);
      loop->tick(wall);
    }
  }
  [[nodiscard]] std::ptrdiff_t count(const std::string& kind) const {
    return std::count_if(events.begin(), events.end(), [&](const api::Event& e) { return e.kind == kind; });
  }

  std::shared_ptr<FakeMapState> state = std::make_shared<FakeMapState>();
  app::UpdateHub hub;
  std::unique_ptr<app::RobotLoop> loop;
  std::vector<api::Event> events;
  std::vector<api::MissionId> kept;
  int dropped = 0;
  app::WallTime wall;
};

TEST_F(MapCheckpoints, ChangedMapIsKeptOncePerPeriodAndDroppedAtTheEnd) {
  ASSERT_TRUE(loop->start_mission(exploration(), "tester"));
  ticks(298);
  EXPECT_TRUE(kept.empty()) << "the period is 30 s";
  ticks(4);
  EXPECT_EQ(kept, (std::vector<api::MissionId>{"look-round"}));
  state->changed();
  ticks(310);
  EXPECT_EQ(kept.size(), 1U) << "the last one is still being written";
  loop->checkpoint_written({});
  ticks(1);
  EXPECT_EQ(kept.size(), 2U);
  loop->checkpoint_written({});
  ticks(310);
  EXPECT_EQ(kept.size(), 2U) << "nothing has changed";
  EXPECT_EQ(dropped, 0);
  loop->stop();
  EXPECT_EQ(dropped, 1);
}

TEST_F(MapCheckpoints, FailedWriteIsAFaultUntilOneSucceeds) {
  ASSERT_TRUE(loop->start_mission(exploration(), "tester"));
  ticks(310);
  loop->checkpoint_written(fail(Errc::kIo, "the disk is full"));
  ASSERT_EQ(loop->status().faults.size(), 1U);
  EXPECT_EQ(loop->status().faults[0].id, "checkpoint-failed");
  EXPECT_TRUE(loop->missions().running());
  ticks(310);
  EXPECT_EQ(kept.size(), 2U) << "the same map is tried again";
  loop->checkpoint_written({});
  EXPECT_TRUE(loop->status().faults.empty());
}

TEST_F(MapCheckpoints, MissionsThatOnlyUseTheMapKeepNone) {
  api::MissionRequest go = exploration();
  go.task = api::GotoMission{.waypoints = {Point2(2.0, 0.0)}, .final_heading_rad = std::nullopt, .keep_out = {}};
  ASSERT_TRUE(loop->start_mission(go, "tester"));
  ticks(310);
  loop->stop();
  EXPECT_TRUE(kept.empty());
  EXPECT_EQ(dropped, 0);
}

TEST_F(MapCheckpoints, MissionCutOffByACrashGoesOnWhereTheRobotIsFoundInItsMap) {
  EXPECT_FALSE(loop->checkpoint_to_resume());
  loop->offer_unfinished(exploration());
  ASSERT_EQ(loop->checkpoint_to_resume(), std::optional<api::MissionId>("look-round"));
  ASSERT_TRUE(loop->resume_in_map(room_map(), {}));
  EXPECT_FALSE(loop->idle());
  EXPECT_FALSE(loop->missions().present()) << "the robot does not know yet where it is";
  EXPECT_EQ(loop->command_mission(api::MissionCommand::kResume).error().code, Errc::kBusy);
  ticks(20);
  ASSERT_TRUE(loop->missions().running());
  EXPECT_EQ(loop->missions().last()->id, "look-round");
  EXPECT_EQ(dropped, 0) << "a second crash would need it";
  ticks(310);
  EXPECT_EQ(kept.size(), 1U);
  loop->stop();
  EXPECT_EQ(dropped, 1);
}

TEST_F(MapCheckpoints, RobotThatDoesNotFindItsPlaceSaysHowToHelpIt) {
  loop->offer_unfinished(exploration());
  state->lost_because = "no scan fits";
  ASSERT_TRUE(loop->resume_in_map(room_map(), {}));
  ticks(20);
  EXPECT_FALSE(loop->missions().present());
  ASSERT_EQ(count("resume-failed"), 1);
  EXPECT_NE(events.back().text.find("seeker relocalise --at"), std::string::npos) << events.back().text;
  state->lost_because.clear();
  ASSERT_TRUE(loop->relocalise(Pose2{1.0, 0.0, 0.0}));
  ticks(20);
  EXPECT_FALSE(loop->checkpoint_to_resume()) << "its map is loaded already";
  EXPECT_TRUE(loop->command_mission(api::MissionCommand::kResume));
  EXPECT_TRUE(loop->missions().running());
  EXPECT_EQ(state->loads, 1);
}

TEST_F(MapCheckpoints, WithoutAMapTheMissionBeginsAnew) {
  loop->offer_unfinished(exploration());
  ASSERT_TRUE(loop->resume_in_map(fail(Errc::kNotFound, "there is none"), {}));
  EXPECT_TRUE(loop->missions().running());
  EXPECT_EQ(count("resume-without-map"), 0);
  loop->stop();
  loop->offer_unfinished(exploration());
  const Status again = loop->resume_in_map(fail(Errc::kCorrupt, "the checksum is wrong"), {});
  EXPECT_EQ(count("resume-without-map"), 1);
  EXPECT_FALSE(again) << "its id was used in this run";
}

TEST_F(MapCheckpoints, AnotherMissionVoidsTheMapOfTheCutOffOne) {
  loop->offer_unfinished(exploration());
  api::MissionRequest other = exploration();
  other.id = "another";
  ASSERT_TRUE(loop->start_mission(other, "tester"));
  EXPECT_EQ(dropped, 1);
  EXPECT_FALSE(loop->checkpoint_to_resume());
}

}  // namespace
}  // namespace seeker::testing
