#include "server/sim/shared_world.hpp"

#include <cmath>

#include "tests/unit/server/sim/worlds.hpp"

namespace seeker::sim {
namespace {

using namespace std::chrono_literals;
using testing::square_room;

World room_with_starts(std::vector<Pose2> starts) {
  World world = square_room(10.0);
  world.starts = std::move(starts);
  return world;
}

std::shared_ptr<SharedWorld> exact_robots(const std::vector<Pose2>& starts) {
  std::vector<RobotPlace> places;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    places.push_back({without_errors(RobotModel{}), i + 1, i});
  }
  auto shared = SharedWorld::create(room_with_starts(starts), std::move(places));
  EXPECT_TRUE(shared);
  return *shared;
}

float range_ahead(RobotInWorld& robot, RobotTime now) {
  const LaserScan scan = robot.scan(now);
  return scan.ranges_m[scan.ranges_m.size() / 2];
}

TEST(SharedWorld, RobotsSeeEachOtherAndNotThemselves) {
  const auto shared = exact_robots({Pose2{-2.0, 0.0, 0.0}, Pose2{2.0, 0.0, 0.0}});
  const RobotModel model;
  const double laser_x = model.lidar.base_T_laser.x_m;
  EXPECT_NEAR(range_ahead(shared->robot(0), shared->now()), 4.0 - model.radius_m - laser_x, 1e-3);
  EXPECT_NEAR(range_ahead(shared->robot(1), shared->now()), 3.0 - laser_x, 1e-3);  // the wall
  const SonarScan echo = shared->robot(0).sonar(shared->now());
  EXPECT_TRUE(std::any_of(echo.readings.begin(), echo.readings.end(),
                          [](const SonarReading& reading) { return reading.range_m < 4.0F; }));
}

TEST(SharedWorld, ARobotIsSeenWhereItHasDrivenTo) {
  const auto shared = exact_robots({Pose2{-2.0, 0.0, 0.0}, Pose2{2.0, 0.0, 0.0}});
  const float before_m = range_ahead(shared->robot(0), shared->now());
  shared->robot(1).command({0.5, 0.0});
  shared->advance(2s);
  const double way_m = shared->robot(1).truth().path_length_m;
  EXPECT_GT(way_m, 0.5);
  EXPECT_NEAR(range_ahead(shared->robot(0), shared->now()) - before_m, way_m, 2e-3);
}

TEST(SharedWorld, RobotsThatMeetStopAndCanDriveApart) {
  const auto shared = exact_robots({Pose2{-1.0, 0.0, 0.0}, Pose2{1.0, 0.0, kPi}});
  shared->robot(0).command({0.5, 0.0});
  shared->robot(1).command({0.5, 0.0});
  shared->advance(6s);
  const auto gap_m = [&] {
    return distance_m(shared->robot(0).truth().world_T_base, shared->robot(1).truth().world_T_base) -
           2.0 * RobotModel{}.radius_m;
  };
  EXPECT_NEAR(gap_m(), 0.0, 0.02);
  EXPECT_GE(shared->robot(0).truth().contacts, 1);
  EXPECT_TRUE(shared->robot(0).odometry(shared->now()).stalled);
  shared->robot(0).command({-0.5, 0.0});
  shared->robot(1).command({});
  shared->advance(2s);
  EXPECT_GT(gap_m(), 0.4);
}

TEST(SharedWorld, AStandingRobotIsNotPushed) {
  const auto shared = exact_robots({Pose2{-1.0, 0.0, 0.0}, Pose2{1.0, 0.0, 0.0}});
  shared->robot(0).command({0.5, 0.0});
  shared->advance(8s);
  EXPECT_EQ(shared->robot(1).truth().world_T_base, (Pose2{1.0, 0.0, 0.0}));
  EXPECT_NEAR(shared->robot(0).truth().world_T_base.x_m, 1.0 - 2.0 * RobotModel{}.radius_m, 0.02);
}

struct Stream {
  std::vector<LaserScan> scans;
  std::vector<Pose2> odometry;
  friend bool operator==(const Stream&, const Stream&) = default;
};

/// What each of two robots senses; they are asked in one order or the other.
std::array<Stream, 2> play(bool backwards) {
  auto shared = SharedWorld::create(room_with_starts({Pose2{-2.0, 0.0, 0.0}, Pose2{2.0, 0.5, 0.0}}),
                                    {RobotPlace{{}, 7, 0}, RobotPlace{{}, 8, 1}});
  EXPECT_TRUE(shared);
  std::array<Stream, 2> streams;
  for (int tick = 0; tick < 30; ++tick) {
    for (std::size_t k = 0; k < 2; ++k) {
      const std::size_t i = backwards ? 1 - k : k;
      RobotInWorld& robot = (*shared)->robot(i);
      streams[i].scans.push_back(robot.scan((*shared)->now()));
      streams[i].odometry.push_back(robot.odometry((*shared)->now()).odom_T_base);
      robot.command({0.4, i == 0 ? 0.2 : -0.3});
    }
    (*shared)->advance(100ms);
  }
  return streams;
}

TEST(SharedWorld, TheOrderOfTheRobotsChangesNothing) { EXPECT_EQ(play(false), play(true)); }

TEST(SharedWorld, PeopleWaitForEveryRobot) {
  World world = room_with_starts({Pose2{-4.0, -4.0, 0.0}, Pose2{2.0, 0.0, 0.0}});
  PersonPath person;
  person.waypoints = {{-2.0, 0.0}, {4.0, 0.0}};
  world.people = {person};
  world.people_walk = true;
  const auto shared = SharedWorld::create(std::move(world),
                                          {RobotPlace{without_errors({}), 1, 0}, RobotPlace{without_errors({}), 1, 1}});
  ASSERT_TRUE(shared);
  (*shared)->advance(10s);
  EXPECT_EQ((*shared)->robot(1).truth().contacts, 0);
  const Scene& scene = (*shared)->robot(1).scene();
  ASSERT_EQ(scene.moving().size(), 2U);
  EXPECT_LT(scene.moving().front().centre.x(), 2.0 - RobotModel{}.radius_m);
}

TEST(SharedWorld, RefusesRobotsThatHaveNoRoom) {
  const auto refused = [](std::vector<Pose2> starts, std::vector<RobotPlace> places) {
    const auto shared = SharedWorld::create(room_with_starts(std::move(starts)), std::move(places));
    return shared ? std::string() : shared.error().message;
  };
  EXPECT_NE(refused({Pose2{}, Pose2{0.3, 0.0, 0.0}}, {RobotPlace{{}, 1, 0}, RobotPlace{{}, 1, 1}})
                .find("start 1 leaves no room"),
            std::string::npos);
  EXPECT_NE(refused({Pose2{}}, {RobotPlace{{}, 1, 1}}).find("start poses"), std::string::npos);
  EXPECT_NE(refused({Pose2{}}, {}).find("1 to 16 robots"), std::string::npos);
}

TEST(SharedWorld, CamerasSeeOtherRobots) {
  const auto alone = exact_robots({Pose2{}});
  const auto together = exact_robots({Pose2{}, Pose2{1.5, 0.0, 0.0}});
  EXPECT_NE(alone->robot(0).omni_image({}), together->robot(0).omni_image({}));
}

}  // namespace
}  // namespace seeker::sim
