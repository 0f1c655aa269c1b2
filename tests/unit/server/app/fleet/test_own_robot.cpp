#include "server/app/fleet/own_robot.hpp"

#include "tests/support/matchers.hpp"
#include "tests/unit/server/app/fleet/fleet_fixture.hpp"

namespace seeker::testing {
namespace {

using app::OwnRobot;
using app::OwnSeen;

TEST(OwnRobot, IsTheFirstMemberOfItsFleetAtItsOwnOrigin) {
  OwnRobot main("main");
  main.take_map({small_map(3), Pose2{1.0, 0.5, 0.0}}, false);
  const api::FleetMember entry = main.describe();
  EXPECT_EQ(entry.robot_id, "main");
  EXPECT_EQ(entry.state, api::FleetState::kMerged);
  EXPECT_EQ(entry.nodes, 3U);
  EXPECT_EQ(entry.places.size(), 3U);
  EXPECT_EQ(entry.main_T_map, Pose2{});
  EXPECT_EQ(entry.main_T_base, (Pose2{1.0, 0.5, 0.0}));
}

TEST(OwnRobot, TakesNothingBackWhileItHasLostItsPose) {
  OwnRobot main("main");
  EXPECT_TRUE(main.receive(OwnSeen{true, floor_with({1.0, 1.0}), {found_at(1, {1.0, 1.0})}, {}}, kStart));
  EXPECT_FALSE(main.receive(OwnSeen{}, kStart));
  EXPECT_EQ(main.report().finds.now.size(), 1U);
  EXPECT_TRUE(main.report().floor);
}

TEST(OwnRobot, ForgetsSearchedFloorThatItsLoopDoesNotReportAnyMore) {
  OwnRobot main("main");
  static_cast<void>(main.receive(OwnSeen{true, {}, {}, searched_at({}, 3, 200)}, kStart));
  EXPECT_TRUE(main.report().search.floor);
  static_cast<void>(main.receive(OwnSeen{true, {}, {}, {}}, kStart));
  EXPECT_FALSE(main.report().search.floor);
}

TEST(OwnRobot, HoldsWhatIsRememberedUntilItHasTakenUpItsMap) {
  OwnRobot main("main");
  main.recall(small_map(), at_place("main", {2.0, 1.0}), {found_at(1, {1.0, 1.0})});
  EXPECT_TRUE(main.remembered());
  EXPECT_FALSE(main.report().topology->active);
  EXPECT_FALSE(main.report().topology->velocity);
  main.receive(app::OwnTopology(at_place("main", {9.0, 9.0})));
  EXPECT_EQ(main.report().topology->map_T_base, (Pose2{2.0, 1.0, 0.0})) << "its loop is in another frame";
  EXPECT_FALSE(main.receive(OwnSeen{true, {}, {found_at(2, {1.0, 1.0})}, {}}, kStart));
  main.take_map({small_map(), std::nullopt}, false);
  EXPECT_FALSE(main.remembered());
  EXPECT_EQ(main.describe().detections.size(), 1U);
  main.keep_remembered();
  EXPECT_TRUE(main.remembered());
}

TEST(OwnRobot, DropsItsReportWithItsMapButNotTheTopologyThatItsLoopHasReportedSince) {
  OwnRobot main("main");
  static_cast<void>(main.receive(OwnSeen{true, floor_with({1.0, 1.0}), {found_at(1, {1.0, 1.0})}, {}}, kStart));
  main.receive(app::OwnTopology(at_place("main", {2.0, 1.0})));
  main.take_map({small_map(2, 9), std::nullopt}, true);
  EXPECT_TRUE(main.report().finds.all().empty());
  EXPECT_FALSE(main.report().floor);
  EXPECT_TRUE(main.report().topology);
  main.recall(small_map(), at_place("main", {2.0, 1.0}), {});
  main.take_map({small_map(2, 9), std::nullopt}, true);
  EXPECT_FALSE(main.report().topology) << "that was of the remembered map";
}

}  // namespace
}  // namespace seeker::testing
