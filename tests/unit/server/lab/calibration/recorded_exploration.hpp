/// \file
/// A simulated robot that explores the office while it is recorded.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "server/app/composition/robot_assembly.hpp"
#include "server/app/loop/robot_loop.hpp"
#include "server/app/robot/drive_recorder.hpp"
#include "tests/support/data.hpp"

namespace seeker::lab {

/// Explores for at most `limit_s` of robot time and records into `log`; `look` is called before every tick.
inline void explore_and_record(const std::filesystem::path& log, std::uint64_t seed, double limit_s,
                               const std::vector<std::string>& settings,
                               const std::function<void(const app::RobotLoop&)>& look = {}) {
  std::vector<std::string> overrides = {"sim.world=../worlds/office-no-target.yaml",
                                        "sim.seed=" + std::to_string(seed)};
  overrides.insert(overrides.end(), settings.begin(), settings.end());
  const auto options =
      app::load_robot_options(seeker::testing::source_file("config/robots/sim.yaml"), overrides).value();
  const auto recorder = app::DriveRecorder::create(log, options.robot_id, 0.0);
  ASSERT_TRUE(recorder) << recorder.error().message;
  app::UpdateHub hub;
  app::RobotLoop loop(options.loop, app::assemble(options).value().parts, hub);
  (*recorder)->follow(loop.hooks());  // before the first reading
  loop.start();
  api::MissionRequest request;
  request.id = "explore";
  request.task = api::ExploreMission{api::ExploreStrategy::kFrontier, std::nullopt, {}, false};
  ASSERT_TRUE(loop.commands().start_mission(request, "test"));
  while (loop.missions().present() && loop.now() < robot_time_s(limit_s)) {
    if (look) {
      look(loop);
    }
    loop.tick({});
  }
}

}  // namespace seeker::lab
