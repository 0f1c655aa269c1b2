#include "server/app/maps/robot_map.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/support/maps/fake_map_tracker.hpp"
#include "tests/support/maps/random_map.hpp"

namespace seeker::app {
namespace {

using testing::FakeMapState;
using testing::FakeMapTracker;

class RobotMapTest : public ::testing::Test {
 protected:
  RobotMapTest() { state->map = testing::room_map(); }

  /// One tick without a live scan.
  PoseEstimate tick() {
    now += seconds(0.1);
    const PoseEstimate estimate = map.follow(tracker.estimate(), now);
    map.step();
    return estimate;
  }

  std::shared_ptr<FakeMapState> state = std::make_shared<FakeMapState>();
  FakeMapTracker tracker{state};
  RobotMap map{{.render_scans_per_tick = 1}, {}, &tracker};
  RobotTime now;
};

TEST_F(RobotMapTest, RisingEpochWritesTheKeptScansAnewOverSomeTicks) {
  state->map.keyframes.resize(3, state->map.keyframes.front());
  tick();
  EXPECT_FALSE(map.rendering());
  EXPECT_EQ(map.tiles_since(0).tiles.size(), 0U);
  ++state->estimate.map_epoch;
  tick();
  EXPECT_TRUE(map.rendering());
  EXPECT_EQ(map.tiles_since(0).map_epoch, 0U) << "tiles carry the epoch of the map they were written in";
  tick();
  tick();
  EXPECT_FALSE(map.rendering());
  const api::TileUpdate tiles = map.tiles_since(0);
  EXPECT_EQ(tiles.map_epoch, 1U);
  EXPECT_GT(tiles.tiles.size(), 0U);
  // The wall lies on the border of two cells, and the beam along the axis on that of two others.
  double wall = 0.0;
  for (const Point2& p : {Point2(3.98, 0.02), Point2(3.98, -0.02), Point2(4.02, 0.02), Point2(4.02, -0.02)}) {
    wall = std::max(wall, map.occupancy().probability_at(p).value_or(0.0));
  }
  EXPECT_GT(wall, 0.5);
  EXPECT_LT(map.occupancy().probability_at(Point2(1.0, 0.5)).value_or(1.0), 0.5);
}

TEST_F(RobotMapTest, AMapThatHardlyMovedIsWrittenAnewWithoutHurry) {
  state->map.keyframes.resize(12, state->map.keyframes.front());
  RobotMap calm({.render_scans_per_tick = 12, .calm_scans_per_tick = 4}, {}, &tracker);
  const auto ticks_after_move = [&](const Pose2& old_map_T_base) {
    ++state->estimate.map_epoch;
    static_cast<void>(calm.follow(tracker.estimate(), now, old_map_T_base));
    int ticks = 0;
    for (; calm.rendering(); ++ticks) {
      calm.step();
    }
    return ticks;
  };
  const Pose2 here = tracker.estimate().map_T_base;
  EXPECT_EQ(ticks_after_move(here * Pose2{0.02, 0.0, 0.0}), 3);
  EXPECT_EQ(ticks_after_move(here * Pose2{0.2, 0.0, 0.0}), 1);
  EXPECT_EQ(ticks_after_move(here * Pose2{0.0, 0.0, 0.05}), 1);
}

TEST_F(RobotMapTest, AMapThatMovesInEachTickIsFinishedAllTheSame) {
  state->map.keyframes.resize(3, state->map.keyframes.front());
  std::vector<std::uint32_t> finished;
  for (int k = 0; k < 12; ++k) {
    ++state->estimate.map_epoch;
    tick();
    if (!map.rendering()) {
      finished.push_back(map.tiles_since(0).map_epoch);
    }
  }
  EXPECT_EQ(finished, (std::vector<std::uint32_t>{1, 4, 7, 10})) << "each as the map lay when it was begun";
  while (!map.settled()) {
    tick();
  }
  EXPECT_EQ(map.tiles_since(0).map_epoch, 12U);
}

TEST_F(RobotMapTest, AMapThatBendsMovesEachPlaceAsTheLocalMapItLiesIn) {
  state->pieces = {{0, {}, {1.0, 0.0}}, {1, {20.0, 0.0, 0.0}, {1.0, 0.0}}};
  state->estimate.map_T_base = {40.0, 0.0, 0.0};
  tick();
  const Pose2 before = state->estimate.map_T_base;
  state->pieces[1].map_T_piece = {20.0, 0.5, 0.0};
  state->pieces.push_back({2, {39.0, 1.5, 0.0}, {}});  // begun since
  state->estimate.map_T_base = {40.0, 1.5, 0.1};
  ++state->estimate.map_epoch;
  static_cast<void>(map.follow(tracker.estimate(), now, before));
  const MapMove& move = map.last_move();
  EXPECT_EQ(move * Point2(0.0, 3.0), Point2(0.0, 3.0)) << "the first local map is held";
  EXPECT_EQ(move * Point2(22.0, 1.0), Point2(22.0, 1.5));
  EXPECT_EQ(move * before, state->estimate.map_T_base) << "and around the robot all moves as it did";
}

TEST_F(RobotMapTest, ClientsGetTheNewMapWhateverRevisionTheyHad) {
  const LaserScan live = unpack_scan(state->map.keyframes.front());
  for (int k = 0; k < 20; ++k) {
    ASSERT_TRUE(map.integrate(live, {}));
  }
  const std::uint64_t before = map.revision();
  ++state->estimate.map_epoch;
  tick();
  tick();
  ASSERT_FALSE(map.rendering());
  EXPECT_GT(map.revision(), before);
  const api::TileUpdate tiles = map.tiles_since(before);
  EXPECT_EQ(tiles.tiles.size(), map.tiles_since(0).tiles.size());
  for (const OccupancyTile& tile : tiles.tiles) {
    EXPECT_GT(tile.revision, before);
    EXPECT_LE(tile.revision, tiles.revision);
  }
}

TEST_F(RobotMapTest, LiveScansAreNotLostWhileTheMapIsWrittenAnew) {
  state->map.keyframes.clear();
  ++state->estimate.map_epoch;
  static_cast<void>(map.follow(tracker.estimate(), now));
  ASSERT_TRUE(map.rendering());
  const LaserScan live = unpack_scan(testing::room_map().keyframes.front());
  ASSERT_TRUE(map.integrate(live, {}));
  EXPECT_TRUE(map.occupancy().probability_at(Point2(0.0, 0.0))) << "planning goes on";
  tick();
  EXPECT_FALSE(map.rendering());
  EXPECT_TRUE(map.occupancy().probability_at(Point2(0.0, 0.0)));
}

TEST_F(RobotMapTest, LoadedMapIsANewEpochWhateverItsOwnWas) {
  state->estimate.map_epoch = 5;
  EXPECT_EQ(tick().map_epoch, 5U);
  while (map.rendering()) {
    tick();
  }
  LineMap other = testing::room_map(20.0, 10.0);
  other.epoch = 0;
  ASSERT_TRUE(map.load(other, {"office", 0, api::MapUse::kLocalise}, now));
  EXPECT_EQ(state->use, slam::MapUse::kLocalise);
  EXPECT_EQ(map.tiles_since(0).tiles.size(), 0U) << "nothing of the old map";
  EXPECT_TRUE(map.relocalising());
  EXPECT_EQ(tick().map_epoch, 6U);
  state->estimate.map_epoch = 1;
  EXPECT_EQ(tick().map_epoch, 7U);
  EXPECT_EQ(map.status()->name, "office");
  EXPECT_EQ(map.status()->use, api::MapUse::kLocalise);
}

TEST_F(RobotMapTest, RefusedMapLeavesEverythingAsItWas) {
  LineMap broken = testing::room_map();
  broken.segments.front().id = 0;
  ASSERT_FALSE(map.load(broken, {"broken", 0, api::MapUse::kContinue}, now));
  EXPECT_EQ(map.identity().name, "");
  EXPECT_FALSE(map.relocalising());
  EXPECT_FALSE(map.rendering());
}

TEST_F(RobotMapTest, RelocalisingEndsWhenFoundWhenLostAndAfterItsTime) {
  ASSERT_TRUE(map.relocalise(std::nullopt, now));
  tick();
  EXPECT_TRUE(map.relocalising());
  state->estimate.quality = LocalisationQuality::kLocalised;
  tick();
  EXPECT_FALSE(map.relocalising());
  ASSERT_TRUE(map.relocalise(std::nullopt, now));
  state->estimate.quality = LocalisationQuality::kLost;
  tick();
  EXPECT_FALSE(map.relocalising());
  ASSERT_TRUE(map.relocalise(std::nullopt, now));
  now += seconds(100.0);
  tick();
  EXPECT_FALSE(map.relocalising());
}

TEST_F(RobotMapTest, SegmentsAreTakenAtMostOncePerPeriod) {
  EXPECT_TRUE(map.take_segments(now));
  state->map.segments.pop_back();
  state->changed();
  EXPECT_FALSE(map.take_segments(now + seconds(0.1)));
  EXPECT_TRUE(map.take_segments(now + seconds(0.6)));
  EXPECT_EQ(map.segments_since(1)->removed, std::vector<std::uint64_t>{4});
  EXPECT_FALSE(map.take_segments(now + seconds(2.0))) << "the tracker's revision is the same";
}

TEST(RobotMap, EstimatorWithoutMapSaysSo) {
  RobotMap map({}, {}, nullptr);
  EXPECT_FALSE(map.status());
  EXPECT_EQ(map.map().error().code, Errc::kNotReady);
  EXPECT_EQ(map.segments_since(0).error().code, Errc::kNotReady);
  EXPECT_EQ(map.relocalise(std::nullopt, {}).error().code, Errc::kNotReady);
  EXPECT_NE(map.load(testing::room_map(), {}, {}).error().message.find("line_slam"), std::string::npos);
}

}  // namespace
}  // namespace seeker::app
