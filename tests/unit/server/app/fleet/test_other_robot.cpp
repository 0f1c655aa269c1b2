#include "server/app/fleet/other_robot.hpp"

#include "tests/support/matchers.hpp"
#include "tests/unit/server/app/fleet/fleet_fixture.hpp"

namespace seeker::testing {
namespace {

app::OtherRobot reporting(const Pose2& map_T_theirs) {
  app::OtherRobot other{"r2", {}, map_T_theirs, false};
  other.report.topology = at_place("r2", {2.0, 1.0});
  static_cast<void>(other.report.receive_seen(floor_with({1.0, 1.0}), {{{0.0, 2.0}, {3.0, 2.0}}},
                                              {found_at(1, {1.0, 0.0})}, searched_at({}, 3, 200), kStart));
  return other;
}

TEST(OtherRobot, IsCarriedIntoTheFrameOfWhoReceivesIt) {
  const std::vector<app::OtherRobot> others{reporting({10.0, 0.0, 0.0})};
  ASSERT_EQ(app::topologies_of(others).size(), 1U);
  EXPECT_THAT(app::topologies_of(others).front().map_T_base.translation(), Point2Near(Point2(12.0, 1.0), 1e-9));
  ASSERT_EQ(app::floors_of(others).size(), 1U);
  EXPECT_EQ(app::floors_of(others).front().first, (Pose2{10.0, 0.0, 0.0}));
  ASSERT_EQ(app::findings_of(others).size(), 1U);
  EXPECT_EQ(app::findings_of(others).front().robot_id, "r2");
  EXPECT_THAT(*app::findings_of(others).front().detection.position, Point2Near(Point2(11.0, 0.0), 1e-9));
  const std::vector<MappedSide> sides = app::sides_by(others);
  ASSERT_EQ(sides.size(), 1U);
  EXPECT_THAT(sides.front().left_map, Point2Near(Point2(10.0, 2.0), 1e-9));
  EXPECT_THAT(sides.front().right_map, Point2Near(Point2(13.0, 2.0), 1e-9));
  const auto searched = app::searched_by(others, kStart, seconds(1));
  ASSERT_EQ(searched.size(), 1U);
  EXPECT_THAT(searched.front().map_T_grid, Pose2Near(Pose2{10.0, 0.0, 0.0}, 1e-9, 1e-9));
}

TEST(OtherRobot, ThatIsSilentHasNoGoalsOfItsOwnAnyMore) {
  app::OtherRobot other = reporting({});
  other.silent = true;
  const std::vector<RobotTopology> topologies = app::topologies_of({other});
  ASSERT_EQ(topologies.size(), 1U);
  EXPECT_FALSE(topologies.front().active);
  EXPECT_FALSE(topologies.front().velocity);
  EXPECT_EQ(topologies.front().topology.nodes.size(), 1U);
}

TEST(OtherRobot, IsLeftOutWhereItHasReportedNothingOrLiesOutOfReach) {
  const app::OtherRobot far = reporting({api::kMaxFleetReach_m + 5.0, 0.0, 0.0});
  const std::vector<app::OtherRobot> others{{"r1", {}, {}, false}, far};
  EXPECT_TRUE(app::topologies_of(others).empty());
  EXPECT_TRUE(app::findings_of(others).empty());
  EXPECT_TRUE(app::sides_by(others).empty());
  EXPECT_TRUE(app::searched_by(others, kStart, seconds(1)).empty());
}

TEST(OtherRobot, ProvesNothingByFloorThatWasSearchedTooLongAgo) {
  EXPECT_TRUE(app::searched_by({reporting({})}, kStart + seconds(1), seconds(1)).empty());
}

}  // namespace
}  // namespace seeker::testing
