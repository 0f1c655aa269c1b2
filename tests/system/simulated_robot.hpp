/// \file
/// A whole robot in its simulated world, stepped by the test: everything of seekerd but the network.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/image/png.hpp"
#include "server/app/composition/robot_assembly.hpp"
#include "server/app/loop/robot_loop.hpp"
#include "tests/support/data.hpp"

namespace seeker::testing {

class SimulatedRobot {
 public:
  /// `overrides` as for seekerd --set. `wrap` may put its own devices around the simulated ones.
  explicit SimulatedRobot(const std::vector<std::string>& overrides = {},
                          const std::string& robot_file = "config/robots/sim.yaml",
                          const std::function<void(app::Devices&)>& wrap = {}) {
    Result<app::RobotOptions> options = app::load_robot_options(source_file(robot_file), overrides);
    if (!options) {
      throw std::runtime_error(options.error().message);
    }
    Result<app::Assembly> assembly = app::assemble(*options);
    if (!assembly) {
      throw std::runtime_error(assembly.error().message);
    }
    if (wrap) {
      wrap(assembly->parts.devices);
    }
    simulation = assembly->simulation;
    faults = assembly->faults;
    loop = std::make_unique<app::RobotLoop>(options->loop, std::move(assembly->parts), hub);
    loop->hooks().on_event = [this](const api::Event& event) { events.push_back(event); };
    loop->start();
  }

  /// Ticks until the mission has ended or `limit_s` of robot time have passed.
  void run(double limit_s) {
    const RobotTime end = loop->now() + seconds(limit_s);
    while (loop->missions().present() && loop->now() < end) {
      tick();
    }
  }
  void tick() {
    wall += std::chrono::milliseconds(100);
    loop->tick(wall);
  }
  void ticks(int count) {
    for (int i = 0; i < count; ++i) {
      tick();
    }
  }

  [[nodiscard]] api::MissionStatus mission() const { return loop->missions().last().value_or(api::MissionStatus{}); }
  [[nodiscard]] api::MissionEnd end() const { return mission().end.value_or(api::MissionEnd{}); }

  app::UpdateHub hub;
  std::shared_ptr<sim::Simulation> simulation;
  std::shared_ptr<drivers::SimFaults> faults;
  std::unique_ptr<app::RobotLoop> loop;
  std::vector<api::Event> events;
  app::WallTime wall;
};

/// A search for the target `name` of config/targets, as `seeker search --target NAME` sends it.
inline api::MissionRequest search_for(const std::string& name, api::SearchMode mode = api::SearchMode::kPlan) {
  api::TargetSpec target;
  target.name = name;
  target.picture = image::read_png(source_file("config/targets/" + name + ".png")).value();
  target.width_m = 0.30;
  target.height_m = 0.70;
  target.depth_m = 0.30;
  api::MissionRequest request;
  request.id = "search-" + name;
  request.task = api::SearchMission{.targets = {target},
                                    .mode = mode,
                                    .on_found = api::OnFound::kApproach,
                                    .bound = std::nullopt,
                                    .keep_out = {},
                                    .gaps_only = false};
  return request;
}

}  // namespace seeker::testing
