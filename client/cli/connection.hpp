/// \file
/// A connected robot, as verbs use it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "common/api/robot_api.hpp"
#include "common/rpc/robot_client.hpp"

namespace seeker::cli {

struct Connection {
  std::shared_ptr<api::RobotApi> robot;
  std::string client_name = "seeker";
  std::function<std::optional<Error>()> link_error = [] { return std::optional<Error>(); };
  api::Role role = api::Role::kOperator;  ///< granted by the robot
  /// Compares the clocks; empty for a robot in memory.
  std::function<void(const api::Reply<rpc::TimeSync>&)> sync_time = {};
};

}  // namespace seeker::cli
