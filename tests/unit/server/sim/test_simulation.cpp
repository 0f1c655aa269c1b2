#include "server/sim/placement.hpp"
#include "tests/unit/server/sim/worlds.hpp"

namespace seeker::sim {
namespace {

using namespace std::chrono_literals;
using testing::make;
using testing::square_room;

struct Stream {
  std::vector<LaserScan> scans;
  std::vector<SonarScan> sonars;
  std::vector<Pose2> odometry;
  friend bool operator==(const Stream&, const Stream&) = default;
};

Stream play(std::uint64_t seed, bool use_camera) {
  Simulation s = make(square_room(5.0), RobotModel{}, seed);
  Stream stream;
  for (int i = 0; i < 50; ++i) {
    s.command({0.3, i % 7 * 0.1 - 0.3});
    s.advance(100ms);
    stream.scans.push_back(s.scan());
    stream.sonars.push_back(s.sonar());
    stream.odometry.push_back(s.odometry().odom_T_base);
    if (use_camera && i % 10 == 0) {
      EXPECT_FALSE(s.omni_image().empty());
    }
  }
  return stream;
}

TEST(Simulation, SameSeedGivesTheSameStreams) {
  EXPECT_EQ(play(7, false), play(7, false));
  EXPECT_FALSE(play(7, false) == play(8, false));
}

TEST(Simulation, OneSensorDoesNotShiftTheNoiseOfAnother) { EXPECT_EQ(play(7, false), play(7, true)); }

TEST(World, RefusesWhatCannotStand) {
  World world = square_room(4.0);
  world.boxes.push_back({Pose2{9.0, 0.0, 0.0}, 1.0, 1.0, 0.0, 1.0, {}});
  EXPECT_NE(validate(world).error().message.find("box 0"), std::string::npos);
  world.boxes[0] = {Pose2{}, 0.0, 1.0, 0.0, 1.0, {}};
  EXPECT_FALSE(validate(world));
  world.boxes.clear();
  world.targets.push_back(Target{"blank", Pose2{}, 0.3, 0.3, 0.7, 0.05, Image()});
  EXPECT_NE(validate(world).error().message.find("no picture"), std::string::npos);
  world.targets.clear();
  world.starts.clear();
  EXPECT_FALSE(validate(world));
}

TEST(RobotModel, RefusesWhatCannotBeSimulated) {
  EXPECT_TRUE(validate(RobotModel{}));
  RobotModel model;
  model.lidar.beams = 0;
  EXPECT_FALSE(validate(model));
  model = {};
  model.omni.shape = 2.0;  // the rim could not be reached
  EXPECT_FALSE(validate(model));
  model = {};
  model.wheel_base_m = 0.0;
  EXPECT_FALSE(validate(model));
}

/// Two rooms of 4 x 4 m and a third without a door.
World three_rooms() {
  World world = square_room(8.0);
  const auto wall = [&](Point2 a, Point2 b) {
    Wall w;
    w.a = a;
    w.b = b;
    world.walls.push_back(w);
  };
  wall({0.0, -4.0}, {0.0, -2.5});  // the door is 1 m wide
  wall({0.0, -1.5}, {0.0, 4.0});
  wall({-4.0, 0.0}, {4.0, 0.0});
  world.starts = {Pose2{-2.0, -2.0, 0.0}};
  world.targets.push_back(Target{"box", Pose2{2.0, -2.0, 0.0}, 0.3, 0.3, 0.7, 0.05, Image(4, 4, 1, 9)});
  return world;
}

TEST(Placement, PutsTargetsWhereTheRobotCanComeNear) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    World world = three_rooms();
    Rng rng(seed);
    const auto placed = place_target(world, 0, rng);
    ASSERT_TRUE(placed) << placed.error().message;
    EXPECT_EQ(world.targets[0].world_T_target, *placed);
    EXPECT_LE(placed->y_m, -0.5);  // not in the rooms without a door, not at their wall
    EXPECT_GE(placed->y_m, -3.5 - 0.05);
    EXPECT_GE(distance_m(*placed, world.starts[0]), 2.0);
    EXPECT_GE(std::abs(placed->x_m), 0.45);  // not in the door
    World again = three_rooms();
    Rng same(seed);
    EXPECT_EQ(place_target(again, 0, same), placed);
  }
}

TEST(Placement, StartsHaveRoomAndAreConnected) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    World world = three_rooms();
    Rng rng(seed);
    const auto start = place_start(world, rng);
    ASSERT_TRUE(start) << start.error().message;
    EXPECT_LT(start->y_m, 0.0);
    EXPECT_TRUE(Simulation::create(world, RobotModel{}, seed));
  }
}

TEST(Placement, ReachableAreaIsTheErodedFloor) {
  EXPECT_NEAR(reachable_area_m2(square_room(4.0), 0.25), 3.5 * 3.5, 0.3);
}

}  // namespace
}  // namespace seeker::sim
