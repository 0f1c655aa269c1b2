/// \file
/// A hosted room with two robots.
#pragma once

#include <gtest/gtest.h>

#include "server/emulator/world_host.hpp"
#include "tests/unit/server/sim/worlds.hpp"

namespace seeker::emulator::testing {

inline drivers::SharedDevices two_robots() {
  sim::World world = sim::testing::square_room(10.0);
  world.starts = {Pose2{-2.0, 0.0, 0.0}, Pose2{2.0, 0.5, 0.0}};
  sim::RobotModel model;
  model.stereo.geometry = {64, 48, 60.0, 32.0, 24.0, 0.12};
  auto shared =
      drivers::make_shared_devices(std::move(world), {sim::RobotPlace{model, 7, 0}, sim::RobotPlace{model, 8, 1}}, 0.0);
  EXPECT_TRUE(shared);
  return std::move(*shared);
}

inline v1::EmulatorHello hello_of(std::uint32_t robot, std::uint64_t instance, std::uint32_t protocol = 1) {
  v1::EmulatorHello hello;
  hello.set_protocol(protocol);
  hello.set_robot(robot);
  hello.set_instance(instance);
  return hello;
}

}  // namespace seeker::emulator::testing
