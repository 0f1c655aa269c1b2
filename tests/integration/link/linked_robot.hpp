/// \file
/// A simulated robot behind its server, with a map that the test writes, and missions that keep it busy.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/log/log.hpp"
#include "common/rpc/robot_client.hpp"
#include "common/rpc/wait.hpp"
#include "tests/support/maps/assembly_with_map.hpp"
#include "tests/support/maps/random_map.hpp"
#include "tests/support/net/await.hpp"
#include "tests/support/served_robot.hpp"

namespace seeker::testing {

using std::chrono::milliseconds;

class LinkedRobot {
 public:
  /// `speed`: robot seconds per second. Maps are kept in the folder.
  LinkedRobot(double speed, const std::filesystem::path& maps, const server_net::ServerParams& params)
      : LinkedRobot(options_at(speed), maps, params) {}

  [[nodiscard]] std::uint16_t port() const { return robot_.port(); }
  /// Another room as the robot's map: its segments are streamed.
  void set_room(double width_m) {
    const std::lock_guard lock(map_->mutex);
    map_->map = room_map(width_m);
    map_->changed();
  }

 private:
  LinkedRobot(const app::RobotOptions& options, const std::filesystem::path& maps,
              const server_net::ServerParams& params)
      : robot_(options, assemble_with_map(options, map_), params, maps) {}
  static app::RobotOptions options_at(double speed) {
    app::RobotOptions options = sim_robot_options({"sim.people=false", "sim.speed=" + std::to_string(speed)});
    options.loop.mission.report_period = milliseconds(100);
    return options;
  }

  std::shared_ptr<FakeMapState> map_ = std::make_shared<FakeMapState>();
  ServedRobot robot_;
};

/// Away from the start and back, so many times: over floor that is free in the demo's world.
inline api::MissionRequest to_and_fro(const api::MissionId& id, int times) {
  api::GotoMission drive;
  for (int k = 0; k < times; ++k) {
    drive.waypoints.emplace_back(1.0, 0.0);
    drive.waypoints.emplace_back(0.0, 0.0);
  }
  api::MissionRequest request;
  request.id = id;
  request.task = drive;
  return request;
}

}  // namespace seeker::testing
