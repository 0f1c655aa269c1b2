/// \file
/// An object that holds the lease of a robot during its lifetime.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "common/api/robot_api.hpp"

namespace seeker::rpc {

struct LeaseKeeperParams {
  std::string client_name;                     ///< name given to the robot, which becomes the owner of the lease
  bool take_over = false;                      ///< true: take the lease from another owner; for people only
  Duration timeout = std::chrono::seconds(5);  ///< wall time for each call
  /// Called once, on the thread that delivers updates, when the lease has another owner or none.
  std::function<void(const api::LeaseState&)> on_lost;
};

/// An acquired lease, which is released when this is destroyed. Watches the robot's status, refreshes a lease that has
/// become stale and reports when it is lost. Do not create or destroy it on the thread that delivers replies, since
/// both wait for a reply.
class LeaseKeeper {
 public:
  /// Acquires the lease. kBusy names the present owner; other errors are those of the call.
  [[nodiscard]] static Result<std::unique_ptr<LeaseKeeper>> acquire(std::shared_ptr<api::RobotApi> robot,
                                                                    LeaseKeeperParams params);
  LeaseKeeper(const LeaseKeeper&) = delete;
  LeaseKeeper& operator=(const LeaseKeeper&) = delete;
  ~LeaseKeeper();

  /// Epoch of the lease, for DriveCommand::lease_epoch; a new one after the lease was stale.
  [[nodiscard]] std::uint64_t epoch() const;
  [[nodiscard]] bool held() const;
  /// Releases the lease early. Further calls have no effect.
  Status release();

 private:
  struct State;
  LeaseKeeper(std::shared_ptr<api::RobotApi> robot, std::shared_ptr<State> state);

  std::shared_ptr<api::RobotApi> robot_;
  std::shared_ptr<State> state_;
  std::unique_ptr<api::Subscription> watch_;
};

}  // namespace seeker::rpc
