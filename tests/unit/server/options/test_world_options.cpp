#include "server/options/world_options.hpp"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "server/sim/placement.hpp"
#include "server/sim/simulation.hpp"
#include "tests/support/data.hpp"

namespace seeker::options {
namespace {

Result<sim::World> build(const std::string& text) {
  const auto file = parse_world(text, "test.yaml");
  if (!file) {
    return tl::unexpected<Error>(file.error());
  }
  return build_world(*file, [](const std::string& name) -> Result<TargetDescription> {
    return TargetDescription{TargetFile{name, "", 0.3, 0.7, 0.3, 0.05, "template"}, Image(4, 8, 1, 10)};
  });
}

std::string error_of(const std::string& text) {
  const auto world = build(text);
  return world ? "no error" : world.error().message;
}

class ShippedWorld : public ::testing::TestWithParam<const char*> {};

TEST_P(ShippedWorld, LoadsAndHasRoomForTheRobotAtEveryStart) {
  const auto world = load_world(testing::source_file(std::string("config/worlds/") + GetParam() + ".yaml"));
  ASSERT_TRUE(world) << world.error().message;
  EXPECT_EQ(world->name, GetParam());
  for (std::size_t i = 0; i < world->starts.size(); ++i) {
    const auto simulation = sim::Simulation::create(*world, sim::RobotModel{}, 1, i);
    EXPECT_TRUE(simulation) << simulation.error().message;
  }
}

INSTANTIATE_TEST_SUITE_P(All, ShippedWorld,
                         ::testing::Values("arena-20", "paper-a", "paper-b", "no-target", "office", "office-no-target",
                                           "demo", "corridor", "hospital", "hall", "closet", "closet-gap", "open-door",
                                           "laboratory", "laboratory-moved", "tank", "tank-no-sphere", "twin-corridors",
                                           "twin-posters", "half-turn"));

TEST(ShippedWorlds, AreAllInTheTestAbove) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(testing::source_file("config/worlds"))) {
    files += entry.path().extension() == ".yaml" ? 1 : 0;
  }
  EXPECT_EQ(files, 22U);
}

TEST(ShippedWorlds, AreAsLargeAsTheyShouldBe) {
  const auto area = [](const char* name) {
    const auto world = load_world(testing::source_file(name));
    EXPECT_TRUE(world) << world.error().message;
    return sim::reachable_area_m2(*world, 0.05);
  };
  // Free floor that N = 10 fits (spec S3.3: N = ceil(S / 1.92)).
  EXPECT_LE(area("config/worlds/paper-a.yaml"), 19.2);
  EXPECT_GE(area("config/worlds/paper-a.yaml"), 16.0);
  EXPECT_LE(area("config/worlds/paper-b.yaml"), 19.2);
  EXPECT_GE(area("config/worlds/paper-b.yaml"), 16.0);
  EXPECT_GE(area("config/worlds/office.yaml"), 290.0);          // 336 m2 of floor without walls and furniture
  EXPECT_NEAR(area("config/worlds/corridor.yaml"), 81.0, 2.0);  // 85 m2 (spec S1.13) less 5 cm along walls
  EXPECT_GE(area("config/worlds/hospital.yaml"), 900.0);        // of 1120 m2
}

TEST(ShippedWorlds, TargetsStandUnder55DegreesOnPaperAndNowhereInTheOthers) {
  for (const char* name : {"config/worlds/paper-a.yaml", "config/worlds/paper-b.yaml"}) {
    const auto world = load_world(testing::source_file(name));
    ASSERT_TRUE(world) << world.error().message;
    ASSERT_EQ(world->targets.size(), 1U);
    const Pose2 target = world->targets[0].world_T_target;
    EXPECT_NEAR(std::atan2(target.y_m, target.x_m) * 180.0 / 3.14159265358979, 55.0, 0.5);
  }
  for (const char* name : {"config/worlds/no-target.yaml", "config/worlds/office-no-target.yaml"}) {
    const auto world = load_world(testing::source_file(name));
    ASSERT_TRUE(world) << world.error().message;
    EXPECT_TRUE(world->targets.empty());
    EXPECT_FALSE(world->boxes.empty());
  }
}

TEST(ShippedWorlds, EveryRoomOfTheOfficeCanBeReached) {
  auto world = load_world(testing::source_file("config/worlds/office.yaml"));
  ASSERT_TRUE(world) << world.error().message;
  const double all = sim::reachable_area_m2(*world, 0.30, 0.1);
  for (int room = 0; room < 5; ++room) {
    for (const double y : {3.0, 11.0}) {
      sim::World from_room = *world;
      // A free place in the middle of the room.
      from_room.starts = {Pose2{4.8 * room + (y > 7.0 ? 1.7 : 3.6), y + (room == 3 ? 1.2 : 1.6), 0.0}};
      EXPECT_NEAR(sim::reachable_area_m2(from_room, 0.30, 0.1), all, 0.1) << "room " << room << " at y " << y;
    }
  }
}

TEST(ShippedWorlds, EveryRoomOfTheHospitalCanBeReached) {
  auto world = load_world(testing::source_file("config/worlds/hospital.yaml"));
  ASSERT_TRUE(world) << world.error().message;
  const Grid<float> floor = sim::reachable_floor(*world, 0.30, 0.1);
  // A free place in every room: south, north, west, east, core, bathrooms.
  const std::vector<Point2> places = {
      {7.3, 5.0},   {9.7, 4.6},   {14.3, 4.8},  {17.0, 4.8},  {21.3, 3.6},  {25.8, 5.0},  {28.8, 4.8},  {33.0, 4.8},
      {7.3, 23.2},  {11.2, 23.2}, {13.9, 24.0}, {18.2, 23.6}, {21.2, 23.4}, {27.2, 23.4}, {30.0, 24.0}, {32.8, 23.4},
      {4.6, 8.2},   {4.8, 11.2},  {4.6, 15.0},  {4.8, 19.8},  {35.2, 8.2},  {35.4, 11.0}, {35.2, 16.6}, {35.2, 20.4},
      {10.2, 10.6}, {14.2, 10.4}, {18.6, 10.4}, {22.7, 12.9}, {25.6, 9.4},  {30.4, 10.8}, {10.8, 18.0}, {16.4, 18.4},
      {20.6, 17.0}, {24.0, 17.6}, {29.4, 17.6}, {1.1, 1.1},   {38.8, 1.1},  {1.1, 27.0},  {38.8, 27.0}};
  for (const Point2& place : places) {
    EXPECT_GE(floor[floor.frame().cell_of(place)], 0.30F) << place.transpose();
  }
}

TEST(ShippedWorlds, NothingOfTheHallIsInReachOfTheLidarFromItsMiddle) {
  auto world = load_world(testing::source_file("config/worlds/hall.yaml"));
  ASSERT_TRUE(world) << world.error().message;
  sim::RobotModel model = sim::without_errors({});
  for (const double heading_rad : {0.0, 1.6, 3.1, -1.6}) {
    world->starts = {Pose2{15.0, 12.5, heading_rad}};
    auto simulation = sim::Simulation::create(*world, model, 1);
    ASSERT_TRUE(simulation) << simulation.error().message;
    for (const float range_m : simulation->scan().ranges_m) {
      EXPECT_FALSE(range_m < model.lidar.range_max_m) << heading_rad;
    }
  }
}

TEST(WorldFile, UnknownKeyNamesFileLineAndPath) {
  EXPECT_EQ(error_of("name: x\nboxes:\n  - {pose: [0, 0, 0], siz_m: [1, 1]}\n"),
            "test.yaml:3: boxes[0].siz_m: unknown key; allowed here: pose, size_m, z_m, surface, object");
  const std::filesystem::path path = std::filesystem::path(::testing::TempDir()) / "bad_world.yaml";
  std::ofstream(path) << "name: x\nlightning: {gain: 1}\n";
  const auto world = load_world(path);
  ASSERT_FALSE(world);
  EXPECT_NE(world.error().message.find(path.string() + ":2: lightning: unknown key"), std::string::npos)
      << world.error().message;
}

TEST(WorldFile, DoorsCutTheWallAndLeaveALintel) {
  const auto world = build(
      "starts: [{pose: [1, 1, 0]}]\nwalls:\n"
      "  - {path: [[0, 2], [5, 2]], doors: [{at_m: 4, width_m: 1}, {at_m: 1, width_m: 0.9, height_m: 9}]}\n");
  ASSERT_TRUE(world) << world.error().message;
  ASSERT_EQ(world->walls.size(), 4U);  // three pieces, and a lintel over the lower door
  EXPECT_NEAR(world->walls[0].b.x(), 0.55, 1e-12);
  EXPECT_NEAR(world->walls[1].a.x(), 1.45, 1e-12);
  EXPECT_NEAR(world->walls[2].z_min_m, 2.05, 1e-12);
  EXPECT_NEAR(world->walls[3].a.x(), 4.5, 1e-12);
}

TEST(WorldFile, RefusesDoorsAndThingsThatDoNotFit) {
  const std::string start = "starts: [{pose: [1, 1, 0]}]\n";
  EXPECT_NE(error_of(start + "walls: [{path: [[0, 2], [5, 2]], doors: [{at_m: 4.9}]}]\n").find("door"),
            std::string::npos);
  EXPECT_NE(error_of(start + "walls: [{path: [[0, 2], [5, 2], [5, 5]], doors: [{at_m: 1}]}]\n").find("two corners"),
            std::string::npos);
  EXPECT_NE(error_of(start + "walls: [{path: [[0, 2], [9, 2]]}]\n").find("wall 0"), std::string::npos);
  EXPECT_NE(error_of("name: x\n").find("starts"), std::string::npos);
  EXPECT_NE(error_of(start + "tables: [{pose: [1, 1, 0], shape: {leg_m: 3}}]\n").find("test.yaml:2"),
            std::string::npos);
}

TEST(WorldFile, OverridesReachIntoTheWorld) {
  const auto world =
      load_world(testing::source_file("config/worlds/office.yaml"), {"people_walk=true", "lighting.gain=0.5"});
  ASSERT_TRUE(world) << world.error().message;
  EXPECT_TRUE(world->people_walk);
  EXPECT_EQ(world->lighting.gain, 0.5);
}

TEST(WorldFile, ATankHasSolidsAndWaterAndAWorldOnItsBaseMayHaveOthers) {
  const auto tank = load_world(testing::source_file("config/worlds/tank.yaml"));
  ASSERT_TRUE(tank) << tank.error().message;
  EXPECT_EQ(tank->solids.size(), 4U);
  EXPECT_DOUBLE_EQ(tank->water.attenuation_per_m, 0.5);
  const auto without = load_world(testing::source_file("config/worlds/tank-no-sphere.yaml"));
  ASSERT_TRUE(without) << without.error().message;
  EXPECT_EQ(without->solids.size(), 3U);
  EXPECT_DOUBLE_EQ(without->water.attenuation_per_m, 0.5);
  const std::string start = "name: x\nstarts: [{pose: [1, 1, 0]}]\n";
  EXPECT_NE(error_of(start + "solids: [{shape: cube, pose: [2, 2, 0]}]\n").find("shape"), std::string::npos);
  EXPECT_NE(error_of(start + "solids: [{shape: sphere, pose: [4.99, 2, 0]}]\n").find("solid 0"), std::string::npos);
  EXPECT_NE(error_of(start + "water: {noise: -1}\n").find("water"), std::string::npos);
}

TEST(TargetFile, ShippedTargetsLoadAndTheirPicturesHaveTheirShape) {
  for (const char* name : {"cross", "ring", "arrow"}) {
    const auto target = load_target(testing::source_file(std::string("config/targets/") + name + ".yaml"));
    ASSERT_TRUE(target) << target.error().message;
    EXPECT_EQ(target->file.name, name);
    EXPECT_EQ(target->picture.width_px(), 128);
    EXPECT_NEAR(static_cast<double>(target->picture.height_px()) / target->picture.width_px(),
                target->file.height_m / target->file.width_m, 0.01);
    EXPECT_LT(*target->picture.at(0, 0), 40);  // a dark border all around
  }
  EXPECT_EQ(load_target("nowhere.yaml").error().code, Errc::kNotFound);
  const auto solid = load_target(testing::source_file("config/targets/sphere.yaml"));
  ASSERT_FALSE(solid);
  EXPECT_NE(solid.error().message.find("places it under `solids`"), std::string::npos) << solid.error().message;
}

}  // namespace
}  // namespace seeker::options
