/// \file
/// The loop of a simulated robot whose map the test writes, stepped by the test.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "server/app/loop/robot_loop.hpp"
#include "tests/support/data.hpp"
#include "tests/support/maps/assembly_with_map.hpp"

namespace seeker::testing {

class LoopWithMap : public ::testing::Test {
 protected:
  /// `exchange` may put other parts in the place of the robot's. The test starts the loop.
  explicit LoopWithMap(const std::function<void(app::LoopParts&)>& exchange) {
    const app::RobotOptions options = app::load_robot_options(source_file("config/robots/sim.yaml")).value();
    app::Assembly assembly = assemble_with_map(options, state);
    exchange(assembly.parts);
    loop = std::make_unique<app::RobotLoop>(options.loop, std::move(assembly.parts), hub);
    loop->hooks().on_event = [this](const api::Event& event) { events.push_back(event); };
  }

  void ticks(int count) {
    for (int k = 0; k < count; ++k) {
      wall += std::chrono::milliseconds(100);
      loop->tick(wall);
    }
  }
  /// Number of events of a kind.
  [[nodiscard]] std::ptrdiff_t count(const std::string& kind) const {
    return std::count_if(events.begin(), events.end(), [&](const api::Event& e) { return e.kind == kind; });
  }

  std::shared_ptr<FakeMapState> state = std::make_shared<FakeMapState>();
  app::UpdateHub hub;
  std::unique_ptr<app::RobotLoop> loop;
  std::vector<api::Event> events;
  app::WallTime wall;
};

}  // namespace seeker::testing
