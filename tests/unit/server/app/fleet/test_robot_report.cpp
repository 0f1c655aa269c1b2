#include "server/app/fleet/robot_report.hpp"

#include "tests/support/matchers.hpp"
#include "tests/unit/server/app/fleet/fleet_fixture.hpp"

namespace seeker::testing {
namespace {

using app::RobotReport;

TEST(RobotReport, KeepsThePlacesOfARobotThatKnowsFewerNow) {
  RobotReport report;
  report.receive_topology(at_place("r1", {2.0, 1.0}));
  RobotTopology restarted;
  restarted.robot_id = "r1";
  restarted.map_T_base = {5.0, 1.0, 0.0};
  report.receive_topology(restarted);
  ASSERT_TRUE(report.topology);
  EXPECT_EQ(report.topology->topology.nodes.size(), 1U);
  EXPECT_EQ(report.topology->map_T_base, restarted.map_T_base);
  EXPECT_FALSE(report.topology->active);
  EXPECT_FALSE(report.topology->target_map);
}

TEST(RobotReport, OfARobotThatHasLostItsPoseHoldsTheLastPoseWithoutAVelocity) {
  RobotReport report;
  report.receive_topology(std::nullopt);
  EXPECT_FALSE(report.topology);
  report.receive_topology(at_place("r1", {2.0, 1.0}));
  report.receive_topology(std::nullopt);
  ASSERT_TRUE(report.topology);
  EXPECT_EQ(report.topology->map_T_base, (Pose2{2.0, 1.0, 0.0}));
  EXPECT_FALSE(report.topology->velocity);
  EXPECT_FALSE(report.topology->active);
}

TEST(RobotReport, ListsEveryFindOnceWithTheNewestReportOfIt) {
  RobotReport report;
  report.finds.now = {found_at(2, {1.0, 1.0})};
  report.finds.before = {found_at(1, {4.0, 4.0}), found_at(2, {9.0, 9.0})};
  const std::vector<api::Detection> all = report.finds.all();
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].id, 1U);
  EXPECT_THAT(*all[1].position, Point2Near(Point2(1.0, 1.0), 1e-12));
}

TEST(RobotReport, SaysWhetherOtherTargetsWereFound) {
  RobotReport report;
  const std::vector<api::Detection> found{found_at(1, {1.0, 1.0})};
  EXPECT_TRUE(report.receive_seen(floor_with({2.0, 2.0}), {}, found, {}, kStart));
  EXPECT_TRUE(report.floor);
  EXPECT_FALSE(report.receive_seen({}, {}, found, {}, kStart));
  EXPECT_FALSE(report.floor);
  EXPECT_TRUE(report.receive_seen({}, {}, {}, {}, kStart)) << "it takes one back";
}

TEST(RobotReport, DatesSearchedFloorByItsLastChangeAndForgetsNone) {
  RobotReport report;
  const SearchedFloor searched = searched_at({}, 3, 200);
  static_cast<void>(report.receive_seen({}, {}, {}, searched, kStart));
  static_cast<void>(report.receive_seen({}, {}, {}, searched, kStart + seconds(5)));
  EXPECT_EQ(report.search.changed, kStart);
  static_cast<void>(report.receive_seen({}, {}, {}, {}, kStart + seconds(6)));
  EXPECT_EQ(report.search.floor, searched);
  static_cast<void>(report.receive_seen({}, {}, {}, searched_at({}, 4, 200), kStart + seconds(7)));
  EXPECT_EQ(report.search.changed, kStart + seconds(7));
}

TEST(RobotReport, CarriesFindsWithoutThoseOutOfReach) {
  RobotReport report;
  report.finds.now = {found_at(1, {1.0, 0.0}), found_at(2, {api::kMaxFleetReach_m - 2.0, 0.0})};
  const std::vector<api::Detection> there = report.finds_in({10.0, 0.0, 0.0});
  ASSERT_EQ(there.size(), 1U);
  EXPECT_THAT(*there[0].position, Point2Near(Point2(11.0, 0.0), 1e-9));
}

}  // namespace
}  // namespace seeker::testing
