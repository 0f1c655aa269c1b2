// What missions find and search, as the executor keeps it.

#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "tests/support/matchers.hpp"
#include "tests/unit/server/app/missions/mission_fixture.hpp"

namespace seeker::app {
namespace {

using std::chrono::seconds;

SearchedFloor searched_floor() {
  return {{"mug"}, {}, std::make_shared<const Grid<std::uint8_t>>(GridFrame{}, 2, 2, std::uint8_t{100})};
}

class MissionResultsTest : public MissionFixture {};

TEST_F(MissionResultsTest, MovedMapMovesTheMissionAndResultsCarryTheirEpoch) {
  ASSERT_TRUE(executor.start(request("one"), "anna", situation));
  script->grid = api::GridReport{};
  script->next.phase = "cover";
  static_cast<void>(tick());
  EXPECT_EQ(executor.findings().grid()->map_epoch, 0U);
  situation.pose.map_epoch = 3;
  situation.pose.map_T_base.x_m = 5.0;
  executor.map_moved({.move = Pose2{5.0, 0.0, 0.0}, .from_epoch = 0, .to_epoch = 3}, situation.now);
  ASSERT_TRUE(script->moved);
  EXPECT_EQ(*script->moved, (Pose2{5.0, 0.0, 0.0}));
  EXPECT_EQ(events.back().kind, "map-moved");
  script->next.phase = "approach";
  static_cast<void>(tick());
  EXPECT_EQ(executor.findings().grid()->map_epoch, 3U);
  EXPECT_EQ(executor.findings().grid()->evidence.map_epoch, 3U);
  EXPECT_DOUBLE_EQ(executor.last()->path_length_m, 0.0) << "the robot did not drive where the map moved";
  executor.end(api::Outcome::kOperator, "test", "", situation.now);
  script->moved.reset();
  executor.map_moved({.move = Pose2{1.0, 0.0, 0.0}, .from_epoch = 3, .to_epoch = 4}, situation.now);
  EXPECT_FALSE(script->moved);
  EXPECT_EQ(executor.findings().grid()->map_epoch, 3U) << "the grid of an ended mission keeps its epoch";
}

TEST_F(MissionResultsTest, TheStartStaysWhereThePartOfTheMapStaysThatItLiesIn) {
  ASSERT_TRUE(executor.start(request("one"), "anna", situation));
  static_cast<void>(tick());
  situation.pose.map_T_base = {40.0, 0.0, 0.0};
  static_cast<void>(tick());
  const MapMove bent(std::vector<MapMove::Piece>{{{40.0, 0.0}, {0.0, 1.5, 0.1}}, {{1.0, 0.0}, {}}});
  executor.map_moved({.move = bent, .from_epoch = 0, .to_epoch = 1}, situation.now);
  ASSERT_TRUE(executor.so_far());
  EXPECT_EQ(executor.so_far()->start_map, Point2(0.0, 0.0));
}

api::Detection mug_at(const Point2& p_map) {
  api::Detection mug;
  mug.id = 1;
  mug.target = "mug";
  mug.position = p_map;
  return mug;
}

TEST_F(MissionResultsTest, WhatWasFoundBeforeTheProgramWasCutOffIsListedAgainAndNumbersGoOnAboveIt) {
  api::Detection before = mug_at({2.0, 0.0});
  before.id = 6;
  before.mission = "one";
  before.map_epoch = 9;
  situation.pose.map_epoch = 3;
  ASSERT_TRUE(executor.start(request("one"), "anna", situation, {Point2(0.0, 0.0), seconds(70), {before}}));
  before.map_epoch = 3;
  EXPECT_EQ(executor.detections(), std::vector{before}) << "the map it was loaded with";
  EXPECT_EQ(told, std::vector{before}) << "whoever listens is told";
  script->detections = {mug_at({4.0, 0.0})};
  script->next.phase = "cover";
  static_cast<void>(tick());
  ASSERT_EQ(executor.detections().size(), 2U) << "what the mission has not seen again is not withdrawn";
  EXPECT_EQ(executor.detections()[1].id, 7U);
  EXPECT_EQ(executor.so_far()->found, executor.detections()) << "for the next time";
  executor.map_moved({.move = Pose2{1.0, 0.0, 0.0}, .from_epoch = 3, .to_epoch = 4}, situation.now);
  EXPECT_EQ(executor.so_far()->found[0].position, Point2(3.0, 0.0));
}

TEST_F(MissionResultsTest, WhatIsFoundAgainAfterTheProgramWasCutOffIsListedOnce) {
  api::Detection before = mug_at({2.0, 0.0});
  before.id = 6;
  before.mission = "one";
  before.position_covariance = 0.01 * Matrix2::Identity();
  ASSERT_TRUE(executor.start(request("one"), "anna", situation, {Point2(0.0, 0.0), seconds(70), {before}}));
  api::Detection again = mug_at({2.1, 0.1});
  again.position_covariance = before.position_covariance;
  script->detections = {again};
  script->next.phase = "cover";
  static_cast<void>(tick());
  ASSERT_EQ(executor.detections().size(), 1U);
  EXPECT_EQ(executor.detections()[0].id, 7U) << "what is refined from now on";
  EXPECT_EQ(told.back().id, 6U);
  EXPECT_TRUE(told.back().withdrawn);
}

TEST_F(MissionResultsTest, WhatAnEndedMissionHasFoundAndSearchedMovesWithTheMapItBelongsTo) {
  ASSERT_TRUE(executor.start(request("one"), "anna", situation));
  script->detections = {mug_at({2.0, 0.0})};
  script->searched = searched_floor();
  static_cast<void>(tick());
  executor.end(api::Outcome::kOperator, "test", "", situation.now);
  const Pose2 new_T_old{1.0, 3.0, kPi / 2.0};
  executor.map_moved({.move = new_T_old, .from_epoch = 0, .to_epoch = 2}, situation.now);
  situation.pose.map_epoch = 2;
  ASSERT_EQ(executor.detections().size(), 1U);
  EXPECT_THAT(*executor.detections()[0].position, testing::Point2Near(Point2(1.0, 5.0), 1e-9));
  EXPECT_EQ(executor.detections()[0].map_epoch, 2U);
  ASSERT_TRUE(executor.searched(situation.pose));
  EXPECT_EQ(executor.searched(situation.pose)->map_T_grid, new_T_old);
  // Another map was loaded: what is left of the one before is no part of it.
  executor.map_moved({.move = new_T_old, .from_epoch = 3, .to_epoch = 4}, situation.now);
  situation.pose.map_epoch = 4;
  EXPECT_EQ(executor.detections()[0].map_epoch, 2U);
  EXPECT_FALSE(executor.searched(situation.pose));
}

TEST_F(MissionResultsTest, WhatARunningMissionHasFoundIsToldAsItsBehaviourHasMovedIt) {
  ASSERT_TRUE(executor.start(request("one"), "anna", situation));
  situation.pose.map_T_base = {1.0, 0.0, 0.0};
  script->detections = {mug_at({2.0, 0.0})};
  static_cast<void>(tick(2.0));
  ASSERT_EQ(told.size(), 1U);
  script->detections = {mug_at({7.0, 0.0})};
  executor.map_moved({.move = Pose2{5.0, 0.0, 0.0}, .from_epoch = 0, .to_epoch = 1}, situation.now);
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told.back().map_epoch, 1U);
  EXPECT_EQ(*executor.detections()[0].position, Point2(7.0, 0.0)) << "moved once, not twice";
  executor.end(api::Outcome::kOperator, "test", "", situation.now);
  EXPECT_EQ(script->asked_about, Point2(6.0, 0.0)) << "its last place has moved, too";
}

TEST_F(MissionResultsTest, RefutedFindIsWithdrawnButNotThatOfAnotherMission) {
  ASSERT_TRUE(executor.start(request("one"), "anna", situation));
  script->detections = {mug_at({2.0, 0.0})};
  static_cast<void>(tick(2.0));
  executor.end(api::Outcome::kOperator, "test", "", situation.now);
  ASSERT_TRUE(executor.start(request("two"), "anna", situation));
  static_cast<void>(tick(2.0));
  ASSERT_EQ(executor.detections().size(), 2U);
  EXPECT_EQ(executor.detections()[0].mission, "one");
  EXPECT_EQ(executor.detections()[1].mission, "two");
  script->detections.clear();
  static_cast<void>(tick(2.0));
  ASSERT_EQ(executor.detections().size(), 1U);
  EXPECT_EQ(executor.detections()[0].mission, "one");
  ASSERT_EQ(told.size(), 3U);
  EXPECT_TRUE(told.back().withdrawn);
  EXPECT_EQ(told.back().id, told[1].id);
  script->detections = {mug_at({3.0, 0.0})};
  executor.end(api::Outcome::kOperator, "test", "", situation.now);
  EXPECT_FALSE(executor.detections().back().withdrawn);
}

TEST_F(MissionResultsTest, FindsOutliveTheWayBackOfALostClientsMission) {
  ASSERT_TRUE(executor.start(request("home", api::LinkPolicy::kReturn), "anna", situation));
  script->detections = {mug_at({2.0, 0.0})};
  executor.client_silent("anna", wall);
  wall += seconds(6);
  static_cast<void>(tick(2.0));
  script->detections.clear();
  static_cast<void>(tick(2.0));
  EXPECT_EQ(executor.detections().size(), 1U);
}

TEST_F(MissionResultsTest, FindsOfAnotherMapAreForgottenAndOfEarlierMissionsTheNewestAreKept) {
  script->detections.resize(1100, mug_at({2.0, 0.0}));
  for (std::size_t k = 0; k < script->detections.size(); ++k) {
    script->detections[k].id = k + 1;
  }
  ASSERT_TRUE(executor.start(request("one"), "anna", situation));
  static_cast<void>(tick(2.0));
  EXPECT_EQ(executor.detections().size(), 1100U) << "its own are all listed";
  executor.end(api::Outcome::kOperator, "test", "", situation.now);
  script->detections.resize(1);
  ASSERT_TRUE(executor.start(request("two"), "anna", situation));
  static_cast<void>(tick(2.0));
  ASSERT_EQ(executor.detections().size(), 1001U);
  EXPECT_EQ(executor.detections().front().id, 101U);
  EXPECT_EQ(executor.detections().back().id, 1101U);
  executor.end(api::Outcome::kOperator, "test", "", situation.now);
  executor.findings().forget_places();
  EXPECT_TRUE(executor.detections().empty());
}

TEST_F(MissionResultsTest, WhatTheLastSearchHasSearchedIsKnownAsLongAsItsMapIsUsed) {
  EXPECT_FALSE(executor.searched(situation.pose));
  ASSERT_TRUE(executor.start(request("one"), "anna", situation));
  script->searched = searched_floor();
  static_cast<void>(tick());
  EXPECT_EQ(executor.searched(situation.pose), script->searched);
  executor.end(api::Outcome::kOperator, "test", "", situation.now);
  const auto searched = std::exchange(script->searched, std::nullopt);
  EXPECT_EQ(executor.searched(situation.pose), searched);
  ASSERT_TRUE(executor.start(request("two"), "anna", situation));
  static_cast<void>(tick());
  EXPECT_EQ(executor.searched(situation.pose), searched) << "that mission does not search";
  situation.pose.map_epoch = 1;
  EXPECT_FALSE(executor.searched(situation.pose));
}

}  // namespace
}  // namespace seeker::app
