/// \file
/// The right to command motion: one client has it at a time. No clock and no thread: the present time is an argument.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "common/api/robot_api.hpp"
#include "common/core/result.hpp"

namespace seeker::app {

struct LeaseParams {
  Duration request_timeout = std::chrono::seconds(10);  ///< wall time in which the owner may answer a request
};

/// A silent owner keeps a stale lease, which others may acquire and it may refresh. Every refusal names the
/// owner and the remedy.
class Lease {
 public:
  using WallTime = std::chrono::steady_clock::time_point;

  explicit Lease(const LeaseParams& params = {}) : params_(params) {}
  /// Uses other times of patience from the next request on.
  void use(const LeaseParams& params) { params_ = params; }

  /// Carries out what `caller` wants. kRefused: the lease is in other hands; kNotFound: nobody has asked for it.
  [[nodiscard]] Result<api::LeaseState> command(const api::Caller& caller, const api::LeaseCommand& command,
                                                WallTime now);
  /// The client went away on purpose: its lease is free or goes to who asks for it, its request is void.
  void forget(const std::string& client);
  /// The client is silent: its lease is stale, its request is void.
  void silent(const std::string& client);
  /// Voids the commands that were given under the present epoch; the owner acquires the lease again to go on.
  void void_commands();
  /// Ends a request that the owner did not answer in time; call it often. True when it did.
  bool watch(WallTime now);

  /// Takes a command that was given under `epoch` with this sequence number; 0: without a number. kRefused: the client
  /// does not own the lease, or the command is an old one.
  [[nodiscard]] Status take(const std::string& client, std::uint64_t epoch, std::uint64_t sequence);
  /// kRefused: the lease is in other hands, so that `client` may not have the robot move. One that is stale is free.
  [[nodiscard]] Status free_for(const std::string& client) const;
  [[nodiscard]] const api::LeaseState& state() const { return state_; }

 private:
  /// Commands of this epoch are void, and why.
  struct Voided {
    std::uint64_t epoch = 0;
    bool stale = false;  ///< by silence; else by a stop
  };

  [[nodiscard]] Result<api::LeaseState> acquire(const std::string& client);
  [[nodiscard]] Result<api::LeaseState> request(const std::string& client, WallTime now);
  [[nodiscard]] Result<api::LeaseState> answer(const std::string& client, bool grant);
  [[nodiscard]] Result<api::LeaseState> take_over(const api::Caller& caller, bool intended);
  void hand_over(const std::string& client);
  void new_epoch(std::optional<Voided> before);
  void drop_request();

  LeaseParams params_;
  api::LeaseState state_;
  std::optional<Voided> voided_;
  std::optional<WallTime> request_until_;
};

}  // namespace seeker::app
