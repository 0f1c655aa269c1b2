/// \file
/// Holds the lease of a robot while it lives.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "common/api/robot_api.hpp"

namespace seeker::rpc {

struct LeaseKeeperParams {
  std::string client_name;                     ///< as given to the robot: the owner to be
  bool take_over = false;                      ///< take it from another owner; for people only
  Duration timeout = std::chrono::seconds(5);  ///< wall time for each call
  /// Told once, on the thread that delivers updates, when somebody else owns the lease or nobody does.
  std::function<void(const api::LeaseState&)> on_lost;
};

/// Acquired lease, released when destroyed. Watches the robot's status and tells when the lease is gone. Do not create
/// or destroy it on the thread that delivers replies: both wait.
class LeaseKeeper {
 public:
  /// Errors: kBusy names the present owner; else as the call's.
  [[nodiscard]] static Result<std::unique_ptr<LeaseKeeper>> acquire(std::shared_ptr<api::RobotApi> robot,
                                                                    LeaseKeeperParams params);
  LeaseKeeper(const LeaseKeeper&) = delete;
  LeaseKeeper& operator=(const LeaseKeeper&) = delete;
  ~LeaseKeeper();

  /// Goes into DriveCommand::lease_epoch.
  [[nodiscard]] std::uint64_t epoch() const;
  [[nodiscard]] bool held() const;
  /// Gives it back before the end. Harmless when repeated.
  Status release();

 private:
  struct State;
  LeaseKeeper(std::shared_ptr<api::RobotApi> robot, std::shared_ptr<State> state);

  std::shared_ptr<api::RobotApi> robot_;
  std::shared_ptr<State> state_;
  std::unique_ptr<api::Subscription> watch_;
};

}  // namespace seeker::rpc
