/// \file
/// HeldLease is the lease of a robot while it lives: acquired, asked for or taken over, and given back at the end.
#pragma once

#include <cstdint>
#include <memory>

#include "client/cli/context.hpp"

namespace seeker::cli {

/// Calls block as long as ask() does.
class HeldLease {
 public:
  /// kRefused names the owner and the remedy. With LeaseAction::kRequest it waits until the owner has answered.
  [[nodiscard]] static Result<std::unique_ptr<HeldLease>> take(const Context& context,
                                                               const api::LeaseCommand& command);
  HeldLease(const HeldLease&) = delete;
  HeldLease& operator=(const HeldLease&) = delete;
  /// Gives the lease back, also after Ctrl-C.
  ~HeldLease();

  /// The next velocity command of this lease.
  [[nodiscard]] api::DriveCommand command(const Twist2& velocity);
  /// Looks whether the lease is still held, and refreshes one that is stale. kRefused names who holds it now.
  [[nodiscard]] Result<api::LeaseState> check();

 private:
  HeldLease(const Context& context, std::uint64_t epoch) : context_(context), epoch_(epoch) {}

  const Context& context_;
  std::uint64_t epoch_;
  std::uint64_t sequence_ = 0;
};

/// Commands `command`, without waiting for an owner who is asked.
[[nodiscard]] Result<api::LeaseState> command_lease(const Context& context, const api::LeaseCommand& command);

}  // namespace seeker::cli
