// Whole robots in one world and one process, each loop on a thread of its own.

#include <array>
#include <thread>

#include <gtest/gtest.h>

#include "server/app/composition/robot_assembly.hpp"
#include "server/app/loop/robot_loop.hpp"
#include "server/app/runtime/update_hub.hpp"
#include "tests/support/data.hpp"

namespace seeker::testing {
namespace {

app::RobotOptions robot(int start) {
  Result<app::RobotOptions> options =
      app::load_robot_options(source_file("config/robots/sim.yaml"),
                              {"sim.world=" + std::string(source_file("config/worlds/corridor.yaml")),
                               "sim.start=" + std::to_string(start), "sim.seed=" + std::to_string(start + 1)});
  EXPECT_TRUE(options) << options.error().message;
  return std::move(*options);
}

/// Drives a metre ahead and leaves the barrier; every pose on the way.
std::vector<Pose2> drive(app::RobotLoop& loop, double way_m) {
  loop.start();
  api::GotoMission go;
  go.waypoints = {Point2(way_m, 0.0)};
  api::MissionRequest request;
  request.id = "ahead";
  request.task = go;
  EXPECT_TRUE(loop.commands().start_mission(request, "test"));
  while (loop.missions().present()) {
    loop.tick({});
  }
  EXPECT_EQ(loop.missions().last()->end->outcome, api::Outcome::kComplete);
  loop.world().let_go();
  return loop.trajectory().poses();
}

std::array<std::vector<Pose2>, 2> run() {
  const std::array<app::RobotOptions, 2> options{robot(0), robot(1)};
  Result<app::SharedAssembly> shared = app::assemble_shared(options);
  if (!shared) {
    ADD_FAILURE() << shared.error().message;
    return {};
  }
  std::array<app::UpdateHub, 2> hubs;
  app::RobotLoop first(options[0].loop, std::move(shared->robots[0].parts), hubs[0]);
  app::RobotLoop second(options[1].loop, std::move(shared->robots[1].parts), hubs[1]);
  std::array<std::vector<Pose2>, 2> ways;
  std::thread other([&] { ways[1] = drive(second, 0.6); });
  ways[0] = drive(first, 1.5);
  other.join();
  EXPECT_GT(shared->world->robot(0).truth().path_length_m, 1.2);
  EXPECT_GT(shared->world->robot(1).truth().path_length_m, 0.4);
  return ways;
}

TEST(SharedLoops, TwoRobotsOfOneProcessDriveTheSameWayEveryTime) {
  const auto once = run();
  EXPECT_GT(once[0].size(), 5U);
  EXPECT_EQ(once, run());
}

}  // namespace
}  // namespace seeker::testing
