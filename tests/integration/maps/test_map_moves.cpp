// A loop closure in the middle of a mission: who follows the map, and when.

#include <gtest/gtest.h>

#include "tests/integration/maps/loop_with_map.hpp"
#include "tests/support/maps/random_map.hpp"

namespace seeker::testing {
namespace {

/// Stands where it is and has found a mug.
class Finder final : public app::Behaviour {
 public:
  explicit Finder(Point2& mug_map) : mug_map_(mug_map) {}
  app::Decision step(const app::Situation& /*situation*/) override { return {}; }
  void map_moved(const MapMove& move) override { mug_map_ = move * mug_map_; }
  std::vector<api::Detection> detections() const override {
    api::Detection mug;
    mug.id = 1;
    mug.target = "mug";
    mug.position = mug_map_;
    return {mug};
  }

 private:
  Point2& mug_map_;
};

class MapMoves : public LoopWithMap {
 protected:
  MapMoves()
      : LoopWithMap([this](app::LoopParts& parts) {
          parts.behaviours = [this, real = parts.behaviours](const api::MissionTask& task,
                                                             const app::Situation& situation) {
            return std::holds_alternative<api::ReturnMission>(task) ||
                           std::holds_alternative<api::LocaliseMission>(task)
                       ? Result<std::unique_ptr<app::Behaviour>>(std::make_unique<Finder>(mug_map))
                       : real(task, situation);
          };
        }) {
    loop->start();
    state->map = room_map();
    state->map.keyframes.resize(100, state->map.keyframes.front());
    state->changed();
  }

  [[nodiscard]] Status go() {
    return go(api::GotoMission{.waypoints = {Point2(2.0, 0.0)}, .final_heading_rad = std::nullopt, .keep_out = {}});
  }
  [[nodiscard]] Status go(const api::MissionTask& task) {
    api::MissionRequest mission;
    mission.id = "go";
    mission.task = task;
    const Result<api::MissionId> id = loop->commands().start_mission(mission, "tester");
    return id ? Status() : Status(tl::unexpected<Error>(id.error()));
  }

  Point2 mug_map{2.0, 1.0};  ///< as the behaviour that stands in for `return` has found it
};

TEST_F(MapMoves, MissionGoesOnPoseAndTilesGetTheNewEpoch) {
  ASSERT_TRUE(go());
  ticks(5);
  const std::uint64_t before = loop->robot_map().revision();
  ++state->estimate.map_epoch;
  state->estimate.map_T_base = Pose2{0.2, 0.0, 0.0} * state->estimate.map_T_base;
  ticks(1);
  EXPECT_EQ(loop->status().pose.map_epoch, 1U);
  EXPECT_EQ(count("map-moved"), 2) << "the robot's log and the mission's";
  EXPECT_TRUE(loop->missions().running());
  EXPECT_TRUE(loop->robot_map().rendering()) << "100 kept scans are more than one tick writes";
  EXPECT_EQ(loop->robot_map().tiles_since(0).map_epoch, 0U);
  ticks(4);
  EXPECT_FALSE(loop->robot_map().rendering());
  const api::TileUpdate tiles = loop->robot_map().tiles_since(before);
  EXPECT_EQ(tiles.map_epoch, 1U);
  EXPECT_FALSE(tiles.tiles.empty());
  const Result<api::SegmentUpdate> segments = loop->robot_map().segments_since(1);
  ASSERT_TRUE(segments);
  ticks(10);
  EXPECT_TRUE(loop->robot_map().segments_since(1)->full);
}

TEST_F(MapMoves, RobotThatIsFoundAgainMovesNothingOfWhatItKnows) {
  for (const bool mission_runs : {true, false}) {
    SCOPED_TRACE(mission_runs ? "in a mission" : "after it");
    const std::uint32_t epoch = loop->status().pose.map_epoch;
    if (mission_runs) {
      ASSERT_TRUE(go(api::ReturnMission{}));
    } else {
      loop->commands().stop();
    }
    ticks(5);
    ASSERT_EQ(loop->missions().detections().size(), 1U);
    // What it maps while it is looked for lies in a frame of its own, until it is joined to the map.
    const Pose2 there = state->estimate.map_T_base;
    state->estimate.quality = LocalisationQuality::kUnknown;
    state->estimate.map_T_base = {};
    ticks(5);
    state->estimate.quality = LocalisationQuality::kLocalised;
    state->estimate.map_T_base = Pose2{7.0, -3.0, 1.0} * there;
    ++state->estimate.map_epoch;
    ticks(1);
    EXPECT_EQ(loop->status().pose.map_epoch, epoch + 1U);
    EXPECT_EQ(loop->missions().present(), mission_runs);
    EXPECT_EQ(loop->missions().detections()[0].map_epoch, epoch + 1U);
    EXPECT_EQ(*loop->missions().detections()[0].position, Point2(2.0, 1.0));
  }
  EXPECT_EQ(count("map-moved"), 0);
  EXPECT_EQ(count("robot-found"), 2);
}

TEST_F(MapMoves, ALostRobotLooksForLandmarksAndDoesNothingElse) {
  ticks(1);
  state->estimate.quality = LocalisationQuality::kLost;
  ticks(5);
  ASSERT_EQ(loop->status().pose.quality, LocalisationQuality::kLost);
  EXPECT_EQ(go().error().code, Errc::kNotReady);
  const Status looking = go(api::LocaliseMission{.landmarks = "lab"});
  EXPECT_TRUE(looking) << looking.error().message;
}

TEST_F(MapMoves, MapIsNotExchangedUnderARunningMission) {
  ASSERT_TRUE(go());
  ticks(5);
  EXPECT_EQ(loop->commands().load_map(room_map(), {"office", 0, api::MapUse::kContinue}).error().code, Errc::kBusy);
  EXPECT_EQ(loop->commands().relocalise(std::nullopt).error().code, Errc::kBusy);
  EXPECT_EQ(state->loads, 0);
}

TEST_F(MapMoves, LoadedMapForgetsTheWayAndHoldsMissionsUntilTheRobotIsFound) {
  ticks(5);
  ASSERT_FALSE(loop->trajectory().stamped().empty());
  ASSERT_TRUE(loop->commands().load_map(room_map(), {"office", 0, api::MapUse::kContinue}));
  EXPECT_TRUE(loop->trajectory().stamped().empty());
  EXPECT_FALSE(loop->idle()) << "the robot needs scans to find its place";
  const Status refused = go();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::kNotReady);
  ticks(20);
  EXPECT_FALSE(loop->robot_map().relocalising());
  EXPECT_TRUE(loop->idle());
  EXPECT_TRUE(go());
}

}  // namespace
}  // namespace seeker::testing
