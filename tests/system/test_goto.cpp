// Drives to places in a simulated corridor with things in the way that the laser does not show, or that move on.

#include <filesystem>
#include <fstream>

#include "tests/support/matchers.hpp"
#include "tests/system/simulated_robot.hpp"

namespace seeker::testing {
namespace {

/// A corridor of 10 m and so wide, with a niche of 3 m depth at 4.5 to 5.5 m; the robot starts at its west end, in the
/// middle. `things` are lines of the world's file. Its path.
std::string corridor(const std::string& name, double width_m, const std::string& things) {
  const std::string half = std::to_string(width_m / 2.0);
  const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / (name + ".yaml");
  std::ofstream(file) << "name: " << name << "\nmin_corner: [-1.5, -5]\nmax_corner: [10, 5]\nstarts:\n"
                      << "  - {pose: [0, 0, 0]}\nwalls:\n  - {path: [[-1, -" << half << "], [4.5, -" << half
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
  EXPECT_EQ(robot.end().unreachable, std::vector<Point2>{Point2(7.0, 0.0)});
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
}

TEST(GotoSystem, APlaceInAMappedWallIsGivenUpAtOnce) {
  SimulatedRobot robot({corridor("goto_wall", 3.0, "")});
  ASSERT_TRUE(robot.loop->commands().start_mission(drive_to({2.0, 1.5}), "test"));
  robot.run(20.0);  // on its way it drives up to the wall
  EXPECT_EQ(robot.end().outcome, api::Outcome::kUnreachable) << robot.mission().activity;
}

}  // namespace
}  // namespace seeker::testing
