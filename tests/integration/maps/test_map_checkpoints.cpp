// The map of a mission that builds one: kept while it runs, loaded again when a crash has cut the mission off.

#include <cmath>

#include <gtest/gtest.h>

#include "server/app/robot/checkpoint_service.hpp"
#include "tests/integration/maps/loop_with_map.hpp"
#include "tests/support/maps/random_map.hpp"
#include "tests/unit/server/store/temporary_folder.hpp"

namespace seeker::testing {
namespace {

/// What a mission was told of its life before a crash.
struct Remembered {
  app::MissionMemory memory;
  std::optional<Point2> start_map;
  std::optional<Duration> time_left;
};

/// Stands still for ever.
class Standing final : public app::Behaviour {
 public:
  explicit Standing(Remembered& remembered) : remembered_(remembered) {}
  app::Decision step(const app::Situation& situation) override {
    remembered_.time_left = situation.time_left;
    return {};
  }
  void remember(const app::MissionMemory& memory) override { remembered_.memory = memory; }
  void remember_start(const Point2& start_map) override { remembered_.start_map = start_map; }

 private:
  Remembered& remembered_;
};

api::MissionRequest exploration() {
  api::MissionRequest request;
  request.id = "look-round";
  request.task = api::ExploreMission{};
  return request;
}

api::Detection found_bag() {
  api::Detection bag;
  bag.id = 3;
  bag.target = "bag";
  bag.mission = "look-round";
  bag.position = Point2(2.0, 1.0);
  return bag;
}

class MapCheckpoints : public LoopWithMap {
 protected:
  MapCheckpoints()
      : LoopWithMap([this](app::LoopParts& parts) {
          parts.behaviours = [this](const api::MissionTask&, const app::Situation&) {
            return Result<std::unique_ptr<app::Behaviour>>(std::make_unique<Standing>(remembered));
          };
        }) {
    loop->hooks().on_checkpoint = [this](const api::MissionId& mission, const app::Checkpoint& checkpoint) {
      kept.push_back(mission);
      EXPECT_EQ(checkpoint.map.map.segments.size(), state->map.segments.size());
    };
    loop->hooks().on_place = [this](const api::MissionId& /*mission*/, const app::MissionPlace& place) {
      ++places;
      place_kept = place;
    };
    loop->hooks().on_checkpoint_unused = [this](const api::MissionId& mission) { set_aside.push_back(mission); };
    loop->hooks().on_checkpoints_void = [this] { ++dropped; };
    loop->start();
    state->map = room_map();
    state->changed();
  }

  std::vector<api::MissionId> kept;
  std::vector<api::MissionId> set_aside;
  Remembered remembered;
  int places = 0;
  app::MissionPlace place_kept;
  int dropped = 0;
};

TEST_F(MapCheckpoints, ChangedMapIsKeptOncePerPeriodAndDroppedAtTheEnd) {
  ASSERT_TRUE(loop->commands().start_mission(exploration(), "tester"));
  ticks(298);
  EXPECT_TRUE(kept.empty()) << "the period is 30 s";
  ticks(4);
  EXPECT_EQ(kept, (std::vector<api::MissionId>{"look-round"}));
  state->changed();
  ticks(310);
  EXPECT_EQ(kept.size(), 1U) << "the last one is still being written";
  loop->mission_control().checkpoints().written({});
  ticks(1);
  EXPECT_EQ(kept.size(), 2U);
  loop->mission_control().checkpoints().written({});
  ticks(310);
  EXPECT_EQ(kept.size(), 2U) << "nothing has changed";
  EXPECT_EQ(dropped, 0);
  loop->commands().stop();
  EXPECT_EQ(dropped, 1);
}

TEST_F(MapCheckpoints, FailedWriteIsAFaultUntilOneSucceeds) {
  ASSERT_TRUE(loop->commands().start_mission(exploration(), "tester"));
  ticks(310);
  loop->mission_control().checkpoints().written(fail(Errc::kIo, "the disk is full"));
  ASSERT_EQ(loop->status().faults.size(), 1U);
  EXPECT_EQ(loop->status().faults[0].id, "checkpoint-failed");
  EXPECT_TRUE(loop->missions().running());
  ticks(310);
  EXPECT_EQ(kept.size(), 2U) << "the same map is tried again";
  loop->mission_control().checkpoints().written({});
  EXPECT_TRUE(loop->status().faults.empty());
}

TEST_F(MapCheckpoints, MissionsThatOnlyUseTheMapKeepNone) {
  api::MissionRequest go = exploration();
  go.task = api::GotoMission{.waypoints = {Point2(2.0, 0.0)}, .final_heading_rad = std::nullopt, .keep_out = {}};
  ASSERT_TRUE(loop->commands().start_mission(go, "tester"));
  ticks(310);
  loop->commands().stop();
  EXPECT_TRUE(kept.empty());
  EXPECT_EQ(dropped, 0);
}

TEST_F(MapCheckpoints, MissionCutOffByACrashGoesOnWhereTheRobotIsFoundInItsMap) {
  EXPECT_FALSE(loop->mission_control().checkpoint_to_resume());
  loop->mission_control().offer_unfinished(exploration());
  ASSERT_EQ(loop->mission_control().checkpoint_to_resume(), std::optional<api::MissionId>("look-round"));
  ASSERT_TRUE(loop->mission_control().resume_in_map(room_map(), {}, "tester"));
  EXPECT_FALSE(loop->idle());
  EXPECT_FALSE(loop->missions().present()) << "the robot does not know yet where it is";
  EXPECT_EQ(loop->commands().command_mission(api::MissionCommand::kResume, "tester").error().code, Errc::kBusy);
  ticks(20);
  ASSERT_TRUE(loop->missions().running());
  EXPECT_EQ(loop->missions().last()->id, "look-round");
  EXPECT_EQ(dropped, 0) << "a second crash would need it";
  ticks(310);
  EXPECT_EQ(kept.size(), 1U);
  loop->commands().stop();
  EXPECT_EQ(dropped, 1);
}

TEST_F(MapCheckpoints, RobotThatDoesNotFindItsPlaceBeginsANewMapAndTheOldOneIsSetAside) {
  loop->mission_control().offer_unfinished(exploration());
  EXPECT_TRUE(loop->mission_control().map_waits_for_resume());
  state->lost_because = "no scan fits";
  ASSERT_TRUE(loop->mission_control().resume_in_map(
      room_map(), {}, "tester",
      {Pose2{1.0, 0.0, 0.0}, {TopologyMemory{}, std::nullopt}, {Point2(5.0, 5.0), {}, {found_bag()}}}));
  EXPECT_FALSE(loop->mission_control().map_waits_for_resume());
  ticks(20);
  ASSERT_TRUE(loop->missions().running());
  EXPECT_EQ(count("resume-anew"), 1);
  EXPECT_EQ(set_aside, (std::vector<api::MissionId>{"look-round"}));
  EXPECT_EQ(dropped, 1) << "the new map is kept under the mission's name from now on";
  EXPECT_TRUE(state->map.segments.empty());
  EXPECT_FALSE(remembered.memory.topology) << "places of another map";
  EXPECT_FALSE(remembered.start_map);
  EXPECT_TRUE(loop->missions().detections().empty());
}

TEST_F(MapCheckpoints, WhatWasFoundBeforeACrashIsListedAgainOnceTheRobotIsFound) {
  loop->mission_control().offer_unfinished(exploration());
  ASSERT_TRUE(loop->mission_control().resume_in_map(room_map(), {}, "tester",
                                                    {Pose2{1.0, 0.0, 0.0}, {}, {Point2(1.0, 0.0), {}, {found_bag()}}}));
  EXPECT_TRUE(loop->missions().detections().empty()) << "where it is, is not known yet";
  ticks(20);
  ASSERT_EQ(loop->missions().detections().size(), 1U);
  const api::Detection& bag = loop->missions().detections()[0];
  EXPECT_EQ(bag.position, found_bag().position);
  EXPECT_EQ(bag.map_epoch, loop->status().pose.map_epoch);
  EXPECT_EQ(place_kept.so_far.found, loop->missions().detections()) << "a second crash would need it";
}

TEST_F(MapCheckpoints, RobotThatIsNotFoundAtOnceTurnsOnceOnTheSpotAndStands) {
  loop->mission_control().offer_unfinished(exploration());
  state->scans_to_search = 100'000;
  ASSERT_TRUE(loop->mission_control().resume_in_map(room_map(), {}, "tester", {Pose2{1.0, 0.0, 0.0}}));
  ticks(25);
  EXPECT_LT(std::abs(loop->status().velocity.omega_rad_s), 0.01) << "it may be found without";
  ticks(20);
  EXPECT_GT(loop->status().velocity.omega_rad_s, 0.1);
  EXPECT_LT(std::abs(loop->status().velocity.v_m_s), 0.01);
  ticks(200);
  EXPECT_LT(std::abs(loop->status().velocity.omega_rad_s), 0.01) << "it has seen all there is";
  EXPECT_FALSE(loop->missions().present());
}

TEST_F(MapCheckpoints, RobotThatLooksRoundIsStoppedByStopAndByEstop) {
  for (const bool estop : {false, true}) {
    loop->mission_control().offer_unfinished(exploration());
    state->scans_to_search = 100'000;
    ASSERT_TRUE(loop->mission_control().resume_in_map(room_map(), {}, "tester", {Pose2{1.0, 0.0, 0.0}}));
    ticks(45);
    ASSERT_GT(loop->status().velocity.omega_rad_s, 0.1);
    estop ? loop->commands().set_estop(true) : loop->commands().stop();
    ticks(10);
    EXPECT_LT(std::abs(loop->status().velocity.omega_rad_s), 0.01);
  }
}

TEST_F(MapCheckpoints, RobotWhoseLeaseSomebodyHoldsDoesNotLookRound) {
  loop->mission_control().offer_unfinished(exploration());
  state->scans_to_search = 100'000;
  ASSERT_TRUE(loop->commands().command_lease({"somebody"}, {api::LeaseAction::kAcquire, false}, {}));
  ASSERT_TRUE(loop->mission_control().resume_in_map(room_map(), {}, "tester", {Pose2{1.0, 0.0, 0.0}}));
  ticks(45);
  EXPECT_LT(std::abs(loop->status().velocity.omega_rad_s), 0.01);
}

TEST_F(MapCheckpoints, WhoHoldsTheLeaseMayResumeAndOwnsTheMission) {
  ASSERT_TRUE(loop->commands().command_lease({"tester"}, {api::LeaseAction::kAcquire, false}, {}));
  loop->mission_control().offer_unfinished(exploration());
  ASSERT_TRUE(loop->mission_control().resume_in_map(room_map(), {}, "tester"));
  ticks(20);
  ASSERT_TRUE(loop->missions().running());
  loop->commands().client_lost("tester", "its connection broke", wall);
  wall += std::chrono::seconds(6);
  ticks(1);
  ASSERT_TRUE(loop->missions().last()->end);
  EXPECT_EQ(loop->missions().last()->end->outcome, api::Outcome::kLinkLost);
}

TEST_F(MapCheckpoints, ResumptionThatIsRefusedForgetsNothing) {
  loop->mission_control().offer_unfinished(exploration());
  app::MissionMemory memory;
  memory.topology.emplace().closed_map = {{2.0, 3.0}};
  ASSERT_TRUE(loop->mission_control().resume_in_map(room_map(), {}, "tester", {Pose2{1.0, 0.5, 0.0}, memory}));
  ASSERT_TRUE(loop->commands().command_lease({"somebody"}, {api::LeaseAction::kAcquire, false}, {}));
  ticks(20);
  EXPECT_EQ(count("resume-failed"), 1);
  EXPECT_FALSE(loop->missions().present());
  ASSERT_TRUE(loop->commands().command_lease({"somebody"}, {api::LeaseAction::kRelease, false}, {}));
  ASSERT_TRUE(loop->commands().command_mission(api::MissionCommand::kResume, "tester"));
  EXPECT_EQ(remembered.memory, memory);
}

TEST_F(MapCheckpoints, MissionGoesOnFromItsStartWithTheTimeThatIsLeft) {
  api::MissionRequest limited = exploration();
  limited.time_limit = std::chrono::seconds(100);
  loop->mission_control().offer_unfinished(limited);
  ASSERT_TRUE(loop->mission_control().resume_in_map(
      room_map(), {}, "tester", {Pose2{1.0, 0.5, 0.0}, {}, {Point2(4.0, -2.0), std::chrono::seconds(60)}}));
  ticks(20);
  ASSERT_TRUE(loop->missions().running());
  EXPECT_EQ(remembered.start_map, std::optional(Point2(4.0, -2.0)));
  ASSERT_TRUE(remembered.time_left);
  EXPECT_LE(*remembered.time_left, Duration(std::chrono::seconds(40)));
  ticks(30);
  loop->mission_control().checkpoints().place_written();
  ticks(10);
  EXPECT_EQ(place_kept.so_far.start_map, std::optional(Point2(4.0, -2.0))) << "for the next crash";
  EXPECT_GT(place_kept.so_far.running, Duration(std::chrono::seconds(63)));
}

TEST_F(MapCheckpoints, MissionGoesOnFromWhereItWasWithWhatItRemembered) {
  loop->mission_control().offer_unfinished(exploration());
  app::MissionMemory memory;
  memory.topology.emplace().closed_map = {{2.0, 3.0}};
  ASSERT_TRUE(loop->mission_control().resume_in_map(room_map(), {}, "tester", {Pose2{1.0, 0.5, 0.0}, memory}));
  ticks(20);
  ASSERT_TRUE(loop->missions().running());
  EXPECT_LT(distance_m(loop->status().pose.map_T_base, {1.0, 0.5, 0.0}), 0.01) << "it was looked for there";
  EXPECT_EQ(remembered.memory, memory);
}

TEST_F(MapCheckpoints, PlaceIsKeptMoreOftenThanTheMapItIsIn) {
  ASSERT_TRUE(loop->commands().start_mission(exploration(), "tester"));
  ticks(290);
  EXPECT_EQ(places, 0) << "it says nothing without a map";
  ticks(15);
  ASSERT_EQ(kept.size(), 1U);
  ticks(30);
  EXPECT_EQ(places, 1) << "the last one is still being written";
  for (int k = 0; k < 5; ++k) {
    loop->mission_control().checkpoints().place_written();
    ticks(10);
  }
  EXPECT_EQ(places, 6);
}

TEST_F(MapCheckpoints, WithoutAMapTheMissionBeginsAnew) {
  loop->mission_control().offer_unfinished(exploration());
  ASSERT_TRUE(loop->mission_control().resume_in_map(fail(Errc::kNotFound, "there is none"), {}, "tester"));
  EXPECT_TRUE(loop->missions().running());
  EXPECT_EQ(count("resume-without-map"), 0);
  loop->commands().stop();
  loop->mission_control().offer_unfinished(exploration());
  const Status again =
      loop->mission_control().resume_in_map(fail(Errc::kCorrupt, "the checksum is wrong"), {}, "tester");
  EXPECT_EQ(count("resume-without-map"), 1);
  EXPECT_FALSE(again) << "its id was used in this run";
}

TEST_F(MapCheckpoints, AnotherMissionVoidsTheMapOfTheCutOffOne) {
  loop->mission_control().offer_unfinished(exploration());
  api::MissionRequest other = exploration();
  other.id = "another";
  ASSERT_TRUE(loop->commands().start_mission(other, "tester"));
  EXPECT_EQ(dropped, 1);
  EXPECT_FALSE(loop->mission_control().checkpoint_to_resume());
}

/// The map of the mission that was cut off is on the disk, and the loop takes its tasks when the test lets it.
class MapOnTheDisk : public MapCheckpoints {
 protected:
  MapOnTheDisk() {
    loop->mission_control().offer_unfinished(exploration());
    service.write("look-round", {{room_map(), {}}, {}, {Pose2{1.0, 0.0, 0.0}, {}}});
  }
  /// Lets the loop do its tasks until this one has been answered.
  const Status& answer() {
    while (!answered) {
      mailbox.wait(std::chrono::seconds(1));
      mailbox.run_pending();
    }
    return *answered;
  }

  TemporaryFolder folder;
  app::MapStore store{{folder.path(), "r1", "1.0"}};
  app::Mailbox mailbox{16};
  app::CheckpointService service{store, *loop, mailbox};
  std::optional<Status> answered;
  bool stopped = false;
  app::StillWanted unless_stopped = [this] { return stopped ? fail(Errc::kCancelled, "stopped") : Status(); };
};

TEST_F(MapOnTheDisk, IsReadAndTheMissionGoesOnInIt) {
  service.resume_mission("tester", unless_stopped, [this](const Status& done) { answered = done; });
  ASSERT_TRUE(answer()) << answer().error().message;
  EXPECT_TRUE(loop->mission_control().resumption().searching());
}

TEST_F(MapOnTheDisk, MissionDoesNotGoOnAfterAStopThatCameWhileItWasRead) {
  service.resume_mission("tester", unless_stopped, [this](const Status& done) { answered = done; });
  mailbox.run_pending();
  ASSERT_FALSE(answered) << "the file is being read, or its map waits for the loop";
  stopped = true;
  loop->commands().stop();
  ASSERT_FALSE(answer());
  EXPECT_EQ(answer().error().code, Errc::kCancelled);
  ticks(20);
  EXPECT_FALSE(loop->mission_control().resumption().searching());
  EXPECT_FALSE(loop->missions().present());
  EXPECT_TRUE(loop->mission_control().checkpoint_to_resume()) << "'resume' may be said again";
}

}  // namespace
}  // namespace seeker::testing
