/// \file
/// A whole robot behind its server, in this process, over real sockets.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "server/app/composition/robot_assembly.hpp"
#include "server/app/robot/robot.hpp"
#include "server/net/server.hpp"
#include "tests/support/data.hpp"

namespace seeker::testing {

/// The options of config/robots/sim.yaml, with `overrides` as for seekerd --set.
[[nodiscard]] inline app::RobotOptions sim_robot_options(const std::vector<std::string>& overrides = {}) {
  return app::load_robot_options(source_file("config/robots/sim.yaml"), overrides).value();
}

/// A server on this port of 127.0.0.1; 0: on a free one.
[[nodiscard]] inline server_net::ServerParams on_port(std::uint16_t port) {
  server_net::ServerParams params;
  params.port = port;
  return params;
}

/// Runs from the constructor to the destructor, without a journal.
class ServedRobot {
 public:
  /// `maps` and `incoming` as for app::Robot.
  ServedRobot(const app::RobotOptions& options, app::Assembly assembly, const server_net::ServerParams& params,
              const std::filesystem::path& maps, const std::filesystem::path& incoming = {})
      : robot_({"r1", "1.0", 0.26}, options.loop, std::move(assembly.parts), nullptr, maps,
               std::move(assembly.landmarks), incoming),
        server_(robot_, params) {
    robot_.start();
    port_ = server_.start().value();
  }
  ServedRobot(const ServedRobot&) = delete;
  ServedRobot& operator=(const ServedRobot&) = delete;
  ~ServedRobot() {
    robot_.stop();
    server_.stop();
  }

  [[nodiscard]] std::uint16_t port() const { return port_; }

 private:
  app::Robot robot_;
  server_net::Server server_;
  std::uint16_t port_ = 0;
};

}  // namespace seeker::testing
