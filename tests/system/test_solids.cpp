// Solids in the simulated tank of turbid water: every part of the robot but the network.

#include <filesystem>
#include <fstream>

#include "common/core/angle.hpp"
#include "tests/support/matchers.hpp"
#include "tests/system/simulated_robot.hpp"

namespace seeker::testing {
namespace {

constexpr const char* kTank = "config/robots/tank.yaml";

api::MissionRequest search_for_sphere() {
  api::MissionRequest request;
  request.id = "search-sphere";
  api::SearchMission search;
  search.targets = {api::solid_target(SolidKind::kSphere)};
  request.task = search;
  return request;
}

api::MissionRequest recognise(std::vector<api::TargetSpec> targets, int headings = 1) {
  api::MissionRequest request;
  request.id = "recognise";
  request.task = api::RecogniseMission{std::move(targets), headings};
  return request;
}

/// Frame `map`.
Point2 place_of(const SimulatedRobot& robot, SolidKind kind) {
  for (const sim::TankSolid& solid : robot.simulation->world().solids) {
    if (solid.shape == kind) {
      return inverse(robot.simulation->truth().world_T_start) * solid.world_T_solid.translation();
    }
  }
  throw std::runtime_error("the world has no such solid");
}

std::vector<api::TargetSpec> all_solids() {
  std::vector<api::TargetSpec> targets;
  for (const SolidKind solid : kSolidKinds) {
    targets.push_back(api::solid_target(solid));
  }
  return targets;
}

TEST(SolidsSystem, RecogniseNamesTheSolidInFrontOfTheCameraAndItsPlace) {
  SimulatedRobot robot({}, kTank);
  ASSERT_TRUE(robot.loop->commands().start_mission(recognise(all_solids()), "test"));
  robot.run(60.0);
  EXPECT_EQ(robot.end().outcome, api::Outcome::kTargetFound) << robot.end().cause;
  ASSERT_EQ(robot.loop->missions().detections().size(), 1U);
  const api::Detection& found = robot.loop->missions().detections().front();
  EXPECT_EQ(found.target, "ellipsoid");
  EXPECT_GT(found.score, 0.5);
  ASSERT_TRUE(found.position);
  EXPECT_THAT(*found.position, Point2Near(place_of(robot, SolidKind::kEllipsoid), 0.15));
  EXPECT_LT(robot.simulation->truth().path_length_m, 0.01) << "it never leaves its place";
}

TEST(SolidsSystem, RecogniseOfWhatIsNotThereIsComplete) {
  SimulatedRobot robot({}, kTank);
  ASSERT_TRUE(
      robot.loop->commands().start_mission(recognise({api::solid_target(SolidKind::kTriangularPrism)}, 3), "test"));
  robot.run(120.0);
  EXPECT_EQ(robot.end().outcome, api::Outcome::kComplete) << robot.end().cause;
  EXPECT_TRUE(robot.loop->missions().detections().empty());
  EXPECT_LT(robot.simulation->truth().path_length_m, 0.05);
}

TEST(SolidsSystem, RecogniseWithADeadCameraIsAFaultWithItsRemedy) {
  SimulatedRobot robot({}, kTank);
  robot.faults->camera_dead = true;
  ASSERT_TRUE(robot.loop->commands().start_mission(recognise(all_solids()), "test"));
  robot.run(120.0);
  EXPECT_EQ(robot.end().outcome, api::Outcome::kFault) << robot.end().cause;
  EXPECT_NE(robot.end().remedy.find("camera"), std::string::npos);
}

TEST(SolidsSystem, ARobotWithoutAModelOrWithAMirrorRefusesSolids) {
  SimulatedRobot no_model({"search.solids.model=''"}, kTank);
  const auto refused = no_model.loop->commands().start_mission(search_for_sphere(), "test");
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("search.solids.model"), std::string::npos) << refused.error().message;
  SimulatedRobot mirror({"search.solids.model=../solids/tank.yaml"});
  const auto omni = mirror.loop->commands().start_mission(recognise(all_solids()), "test");
  ASSERT_FALSE(omni);
  EXPECT_NE(omni.error().message.find("omnidirectional"), std::string::npos) << omni.error().message;
}

TEST(SolidsSystem, RecogniseKnowsPicturesByTheMirrorAtOnceAllAround) {
  const std::filesystem::path world = std::filesystem::path(::testing::TempDir()) / "recognise_room.yaml";
  std::ofstream(world) << "name: room\nmin_corner: [0, 0]\nmax_corner: [6, 5]\nstarts: [{pose: [1.5, 2.5, 90]}]\n"
                       << "walls: [{path: [[0, 0], [6, 0], [6, 5], [0, 5]], closed: true}]\ntargets: [{file: "
                       << source_file("config/targets/cross.yaml").string() << ", pose: [3.3, 2.5, 180]}]\n";
  SimulatedRobot robot({"sim.world=" + world.string()});
  const api::MissionRequest search = search_for("cross");
  ASSERT_TRUE(
      robot.loop->commands().start_mission(recognise(std::get<api::SearchMission>(search.task).targets), "test"));
  robot.run(60.0);
  EXPECT_EQ(robot.end().outcome, api::Outcome::kTargetFound) << robot.end().cause;
  ASSERT_EQ(robot.loop->missions().detections().size(), 1U);
  const api::Detection& found = robot.loop->missions().detections().front();
  EXPECT_EQ(found.target, "cross");
  EXPECT_NEAR(found.bearing_base_rad, -kPi / 2.0, 0.1);
}

TEST(SolidsSystem, TheSphereIsFoundWhereItLiesWithoutAContact) {
  SimulatedRobot robot({}, kTank);
  ASSERT_TRUE(robot.loop->commands().start_mission(search_for_sphere(), "test"));
  robot.run(3600.0);
  EXPECT_EQ(robot.end().outcome, api::Outcome::kTargetFound) << robot.end().cause;
  EXPECT_EQ(robot.simulation->truth().contacts, 0);
  const std::vector<api::Detection>& found = robot.loop->missions().detections();
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found.back().target, "sphere");
  ASSERT_TRUE(found.back().position);
  EXPECT_THAT(*found.back().position, Point2Near(place_of(robot, SolidKind::kSphere), 0.3));
}

TEST(SolidsSystem, ATankWithoutTheSphereIsSearchedToTheEnd) {
  SimulatedRobot robot({"sim.world=../worlds/tank-no-sphere.yaml"}, kTank);
  ASSERT_TRUE(robot.loop->commands().start_mission(search_for_sphere(), "test"));
  robot.run(3600.0);
  EXPECT_EQ(robot.end().outcome, api::Outcome::kNotFoundAreaCovered) << robot.end().cause;
  EXPECT_EQ(robot.simulation->truth().contacts, 0);
  EXPECT_TRUE(robot.loop->missions().detections().empty());
  const api::CoverageSummary coverage = robot.mission().coverage.value();
  EXPECT_GE(coverage.covered_area_m2, 0.9 * coverage.reachable_area_m2);
}

}  // namespace
}  // namespace seeker::testing
