// Drives to places in a simulated corridor with things in the way that the laser does not show, or that move on.

#include <filesystem>
#include <fstream>

#include "tests/support/matchers.hpp"
#include "tests/system/simulated_robot.hpp"

namespace seeker::testing {
namespace {

/// A corridor of 10 m and so wide, with a niche of 3 m depth at 4.5 to 5.5 m; the robot starts at its west end, in the
/// middle, unless `start` says otherwise. `things` are lines of the world's file. Its path.
std::string corridor(const std::string& name, double width_m, const std::string& things,
                     const std::string& start = "[0, 0, 0]") {
  const std::string half = std::to_string(width_m / 2.0);
  const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / (name + ".yaml");
  std::ofstream(file) << "name: " << name << "\nmin_corner: [-1.5, -5]\nmax_corner: [10, 5]\nstarts:\n"
                      << "  - {pose: " << start << "}\nwalls:\n  - {path: [[-1, -" << half << "], [4.5, -" << half
                      << "], [4.5, -4], [5.5, -4], [5.5, -" << half << "], [9, -" << half << "], [9, " << half
                      << "], [-1, " << half << "]], thickness_m: 0, closed: true}\n"
                      << things;
  return "sim.world=" + file.string();
}

/// So low that only the sonars meet it.
constexpr const char* kMat = "boxes:\n  - {pose: [3, 0, 0], size_m: [0.4, 0.5], z_m: [0, 0.24]}\n";

api::MissionRequest drive_to(const Point2& place_map) {
  api::MissionRequest request;
  request.id = "goto";
  request.task = api::GotoMission{.waypoints = {place_map}, .final_heading_rad = std::nullopt, .keep_out = {}};
  return request;
}

/// Of the only place that was not reached.
UnreachableCause cause_of(const api::MissionEnd& end) {
  return end.unreachable.size() == 1 ? end.unreachable.front().cause : UnreachableCause::kNotStated;
}

TEST(GotoSystem, AMatOnTheStraightWayIsDrivenRound) {
  SimulatedRobot robot({corridor("goto_mat", 3.0, kMat)});
  ASSERT_TRUE(robot.loop->commands().start_mission(drive_to({7.0, 0.0}), "test"));
  robot.run(180.0);
  EXPECT_EQ(robot.end().outcome, api::Outcome::kComplete) << robot.mission().activity << " " << robot.end().cause;
  const sim::GroundTruth truth = robot.simulation->truth();
  EXPECT_EQ(truth.contacts, 0);
  EXPECT_THAT(truth.world_T_base.translation(), Point2Near(Point2(7.0, 0.0), 0.25));
}

TEST(GotoSystem, AMatWithNoWayRoundEndsUnreachableAfterABoundedTime) {
  SimulatedRobot robot({corridor("goto_blocked", 1.2, kMat)});
  ASSERT_TRUE(robot.loop->commands().start_mission(drive_to({7.0, 0.0}), "test"));
  robot.run(240.0);
  EXPECT_EQ(robot.end().outcome, api::Outcome::kUnreachable) << robot.mission().activity << " " << robot.end().cause;
  EXPECT_EQ(positions_of(robot.end().unreachable), std::vector<Point2>{Point2(7.0, 0.0)});
  EXPECT_EQ(cause_of(robot.end()), UnreachableCause::kCutOff) << robot.end().cause;
  EXPECT_EQ(robot.simulation->truth().contacts, 0);
}

TEST(GotoSystem, APersonWhoLeavesTheCorridorDoesNotEndTheDrive) {
  // Steps out of the corridor into the niche and takes about half a minute for it.
  SimulatedRobot robot({corridor("goto_person", 1.2,
                                 "people:\n  - {waypoints: [[5, 0], [5, -3.5]], speed_m_s: 0.04, wait_m: 0.05}\n"
                                 "people_walk: true\n")});
  ASSERT_TRUE(robot.loop->commands().start_mission(drive_to({8.0, 0.0}), "test"));
  robot.run(180.0);
  EXPECT_EQ(robot.end().outcome, api::Outcome::kComplete) << robot.mission().activity << " " << robot.end().cause;
  const sim::GroundTruth truth = robot.simulation->truth();
  EXPECT_EQ(truth.contacts, 0);
  EXPECT_THAT(truth.world_T_base.translation(), Point2Near(Point2(8.0, 0.0), 0.25));
}

TEST(GotoSystem, APlaceInAKeptOutAreaIsGivenUpAtOnce) {
  SimulatedRobot robot({corridor("goto_kept_out", 3.0, "")});
  api::MissionRequest request = drive_to({7.0, 0.0});
  std::get<api::GotoMission>(request.task).keep_out = {
      Polygon({Point2(6.0, -1.0), Point2(8.0, -1.0), Point2(8.0, 1.0), Point2(6.0, 1.0)})};
  ASSERT_TRUE(robot.loop->commands().start_mission(request, "test"));
  robot.run(10.0);
  EXPECT_EQ(robot.end().outcome, api::Outcome::kUnreachable) << robot.mission().activity;
  EXPECT_EQ(cause_of(robot.end()), UnreachableCause::kKeptOut) << robot.end().cause;
}

TEST(GotoSystem, APlaceInAMappedWallIsGivenUpAtOnce) {
  SimulatedRobot robot({corridor("goto_wall", 3.0, "")});
  ASSERT_TRUE(robot.loop->commands().start_mission(drive_to({2.0, 1.5}), "test"));
  robot.run(20.0);  // on its way it drives up to the wall
  EXPECT_EQ(robot.end().outcome, api::Outcome::kUnreachable) << robot.mission().activity;
  EXPECT_EQ(cause_of(robot.end()), UnreachableCause::kObstacle) << robot.end().cause;
}

TEST(GotoSystem, APlaceBeyondTheMapIsGivenUpSoonAfterLookingRound) {
  SimulatedRobot robot({corridor("goto_beyond", 3.0, "")});
  ASSERT_TRUE(robot.loop->commands().start_mission(drive_to({60.0, 40.0}), "test"));
  robot.run(30.0);
  EXPECT_EQ(robot.end().outcome, api::Outcome::kUnreachable) << robot.mission().activity;
  EXPECT_EQ(cause_of(robot.end()), UnreachableCause::kUnknownFloor) << robot.end().cause;
  EXPECT_NE(robot.end().remedy.find("explore"), std::string::npos) << robot.end().remedy;
}

TEST(GotoSystem, EveryPlaceHasItsOwnCauseAndRemedy) {
  SimulatedRobot robot({corridor("goto_causes", 3.0, "")});
  api::MissionRequest request = drive_to({2.0, 1.5});
  auto& go = std::get<api::GotoMission>(request.task);
  go.waypoints.emplace_back(6.5, 0.0);
  go.waypoints.emplace_back(1.0, 0.0);
  go.keep_out = {Polygon({Point2(6.0, -1.0), Point2(7.0, -1.0), Point2(7.0, 1.0), Point2(6.0, 1.0)})};
  ASSERT_TRUE(robot.loop->commands().start_mission(request, "test"));
  robot.run(60.0);
  const api::MissionEnd end = robot.end();
  EXPECT_EQ(end.outcome, api::Outcome::kUnreachable) << robot.mission().activity;
  ASSERT_EQ(end.unreachable.size(), 2U) << end.cause;
  EXPECT_EQ(end.unreachable[0].cause, UnreachableCause::kObstacle) << end.cause;
  EXPECT_EQ(end.unreachable[1].cause, UnreachableCause::kKeptOut) << end.cause;
  EXPECT_NE(end.cause.find("2 of 3 places cannot be reached: (2.00, 1.50) m: it lies in an obstacle"),
            std::string::npos)
      << end.cause;
  EXPECT_NE(end.cause.find("(6.50, 0.00) m: it lies in a kept-out area"), std::string::npos) << end.cause;
  EXPECT_NE(end.remedy.find("walls"), std::string::npos) << end.remedy;
  EXPECT_NE(end.remedy.find("kept-out areas"), std::string::npos) << end.remedy;
}

TEST(GotoSystem, ARobotThatFacesAWallLooksRoundAndDrivesToWhatLiesBehindIt) {
  // The wall at x = -1 is 0.27 m before it; whatever is free lies behind, where it has not looked.
  SimulatedRobot robot({corridor("goto_faces_wall", 3.0, "", "[-0.73, 0, 180]")});
  ASSERT_TRUE(robot.loop->commands().start_mission(drive_to({-4.0, 0.0}), "test"));
  robot.run(60.0);
  EXPECT_EQ(robot.end().outcome, api::Outcome::kComplete) << robot.mission().activity << " " << robot.end().cause;
  const sim::GroundTruth truth = robot.simulation->truth();
  EXPECT_EQ(truth.contacts, 0);
  EXPECT_THAT(truth.world_T_base.translation(), Point2Near(Point2(3.27, 0.0), 0.25));
}

}  // namespace
}  // namespace seeker::testing
