#include "server/drivers/sim/tick_barrier.hpp"

#include <thread>

#include <gtest/gtest.h>

#include "server/drivers/sim/sim_devices.hpp"
#include "tests/unit/server/sim/worlds.hpp"

namespace seeker::drivers {
namespace {

using namespace std::chrono_literals;

RobotTime at(Duration since_start) { return RobotTime() + since_start; }

TEST(TickGate, OpensWhenAllHaveFinished) {
  TickGate gate(2);
  EXPECT_FALSE(gate.next());
  gate.wait(0, at(100ms));
  EXPECT_FALSE(gate.next());  // robot 1 has not come yet
  gate.wait(1, at(100ms));
  ASSERT_EQ(gate.next(), at(100ms));
  gate.reached(at(100ms));
  EXPECT_FALSE(gate.waiting(0));
  EXPECT_FALSE(gate.next());
}

TEST(TickGate, WaitsForNobodyThatIsGone) {
  TickGate gate(3);
  gate.wait(0, at(100ms));
  gate.let_go(1);
  EXPECT_FALSE(gate.next());
  gate.let_go(2);
  EXPECT_EQ(gate.next(), at(100ms));
  gate.hold(2);  // it is back
  EXPECT_FALSE(gate.next());
}

TEST(TickGate, StandsStillWhenNobodyTicks) {
  TickGate gate(2);
  gate.let_go(0);
  gate.let_go(1);
  EXPECT_FALSE(gate.next());
}

TEST(TickGate, ReleasesTheFasterRobotFirst) {
  TickGate gate(2);
  gate.wait(0, at(50ms));
  gate.wait(1, at(100ms));
  ASSERT_EQ(gate.next(), at(50ms));
  gate.reached(at(50ms));
  EXPECT_FALSE(gate.waiting(0));
  EXPECT_TRUE(gate.waiting(1));
}

SharedDevices two_robots() {
  sim::World world = sim::testing::square_room(10.0);
  world.starts = {Pose2{-2.0, 0.0, 0.0}, Pose2{2.0, 0.5, 0.0}};
  auto shared = make_shared_devices(std::move(world), {sim::RobotPlace{{}, 7, 0}, sim::RobotPlace{{}, 8, 1}}, 0.0);
  EXPECT_TRUE(shared);
  return std::move(*shared);
}

/// Drives `robot` for a number of ticks and leaves; what it saw.
std::vector<LaserScan> drive(SimDevices& robot, int ticks, double omega_rad_s) {
  std::vector<LaserScan> seen;
  EXPECT_TRUE(robot.base->activate());
  EXPECT_TRUE(robot.lidar->activate());
  EXPECT_TRUE(robot.base->set_motors(true));
  for (int i = 0; i < ticks; ++i) {
    const auto scan = robot.lidar->read();
    if (scan && *scan) {
      seen.push_back(**scan);
    }
    EXPECT_TRUE(robot.base->set_velocity({0.4, omega_rad_s}, robot.clock->now()));
    EXPECT_TRUE(robot.clock->advance(100ms));
  }
  robot.base->deactivate();
  robot.clock->let_go();
  return seen;
}

TEST(TickBarrier, ThreadsGiveTheSameRunEveryTime) {
  const auto run = [] {
    SharedDevices shared = two_robots();
    std::vector<LaserScan> second;
    std::thread other([&] { second = drive(shared.robots[1], 40, -0.3); });
    std::vector<LaserScan> first = drive(shared.robots[0], 60, 0.2);
    other.join();
    EXPECT_EQ(shared.world->now(), at(6s));
    first.insert(first.end(), second.begin(), second.end());
    return first;
  };
  const std::vector<LaserScan> once = run();
  EXPECT_EQ(once.size(), 100U);
  EXPECT_EQ(once, run());
}

TEST(TickBarrier, CallsBetweenTicksOncePerStep) {
  SharedDevices shared = two_robots();
  std::vector<RobotTime> steps;
  shared.barrier->between = [&](RobotTime now) { steps.push_back(now); };
  std::thread other([&] { drive(shared.robots[1], 5, 0.0); });
  drive(shared.robots[0], 5, 0.0);
  other.join();
  EXPECT_EQ(steps, (std::vector<RobotTime>{at(100ms), at(200ms), at(300ms), at(400ms), at(500ms)}));
}

TEST(TickBarrier, ARobotThatComesBackStopsTheWorldAgain) {
  SharedDevices shared = two_robots();
  SimDevices& one = shared.robots[0];
  SimDevices& two = shared.robots[1];
  two.clock->let_go();
  ASSERT_TRUE(one.clock->advance(100ms));
  EXPECT_EQ(shared.world->now(), at(100ms));
  two.clock->hold();
  std::thread waits([&] { EXPECT_TRUE(one.clock->advance(100ms)); });
  EXPECT_EQ(two.clock->now(), at(100ms));  // whatever the other thread does
  ASSERT_TRUE(two.clock->advance(100ms));
  waits.join();
  EXPECT_EQ(shared.world->now(), at(200ms));
}

TEST(TickBarrier, ADestroyedRobotHoldsNobody) {
  SharedDevices shared = two_robots();
  shared.robots.pop_back();
  ASSERT_TRUE(shared.robots[0].clock->advance(100ms));
  EXPECT_EQ(shared.world->now(), at(100ms));
}

}  // namespace
}  // namespace seeker::drivers
