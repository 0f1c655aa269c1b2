/// \file
/// A whole simulated robot behind its server, in this process, over real sockets.
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
#include "server/app/composition/robot_assembly.hpp"
#include "server/app/estimators/tracker_estimator.hpp"
#include "server/app/robot/robot.hpp"
#include "server/net/server.hpp"
#include "tests/support/data.hpp"
#include "tests/support/maps/fake_map_tracker.hpp"
#include "tests/support/maps/random_map.hpp"
#include "tests/support/net/await.hpp"

namespace seeker::testing {

using std::chrono::milliseconds;

class LinkedRobot {
 public:
  /// `speed`: robot seconds per second. Maps are kept in the folder.
  LinkedRobot(double speed, const std::filesystem::path& maps, const server_net::ServerParams& params) {
    app::RobotOptions options = app::load_robot_options(source_file("config/robots/sim.yaml"),
                                                        {"sim.people=false", "sim.speed=" + std::to_string(speed)})
                                    .value();
    options.loop.mission.report_period = milliseconds(100);
    app::Assembly assembly = app::assemble(options).value();
    assembly.parts.estimator = std::make_unique<app::TrackerEstimator>(std::make_unique<FakeMapTracker>(map_));
    robot_ = std::make_unique<app::Robot>(app::RobotIdentity{"r1", "1.0", 0.26}, options.loop,
                                          std::move(assembly.parts), nullptr, maps);
    server_ = std::make_unique<server_net::Server>(*robot_, params);
    robot_->start();
    port_ = server_->start().value();
  }
  LinkedRobot(const LinkedRobot&) = delete;
  LinkedRobot& operator=(const LinkedRobot&) = delete;
  ~LinkedRobot() {
    robot_->stop();
    server_->stop();
  }

  [[nodiscard]] std::uint16_t port() const { return port_; }
  /// Another room as the robot's map: its segments are streamed.
  void set_room(double width_m) {
    const std::lock_guard lock(map_->mutex);
    map_->map = room_map(width_m);
    map_->changed();
  }

 private:
  std::shared_ptr<FakeMapState> map_ = std::make_shared<FakeMapState>();
  std::unique_ptr<app::Robot> robot_;
  std::unique_ptr<server_net::Server> server_;
  std::uint16_t port_ = 0;
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
