#include "client/cli/held_lease.hpp"

#include <string>

namespace seeker::cli {
namespace {

constexpr Duration kCommandLife = std::chrono::milliseconds(300);
/// How often the robot is asked what its owner has answered.
constexpr Duration kAskPeriod = std::chrono::milliseconds(200);

Result<api::LeaseState> lease_of(const Context& context) {
  const auto status = ask<api::RobotStatus>(context, &api::RobotApi::get_status);
  return status ? Result<api::LeaseState>(status->lease) : tl::unexpected<Error>(status.error());
}

/// Waits until the owner has answered or the robot has given the request up.
Result<api::LeaseState> wait_for_answer(const Context& context, Result<api::LeaseState> lease) {
  const auto waits = [&] { return lease && lease->owner != context.client_name; };
  if (waits()) {
    say(context, "'" + lease->owner + "' is asked for the lease and has " +
                     std::to_string(std::chrono::round<std::chrono::seconds>(lease->request_left).count()) +
                     " s to answer");
  }
  while (waits()) {
    if (lease->requested_by != context.client_name) {
      return fail(Errc::kRefused, "'" + lease->owner +
                                      "' keeps the lease: it has denied the request or did not answer in time; take it "
                                      "over with 'seeker lease take-over --yes'");
    }
    if (!sleep_for(context, kAskPeriod)) {
      return fail(Errc::kCancelled, "interrupted while the owner of the lease was asked");
    }
    lease = lease_of(context);
  }
  return lease;
}

Context calm(const Context& context) {
  Context calm = context;
  calm.interrupted = [] { return false; };
  return calm;
}

}  // namespace

Result<api::LeaseState> command_lease(const Context& context, const api::LeaseCommand& command) {
  return ask<api::LeaseState>(
      context, [&](api::Reply<api::LeaseState> reply) { context.robot->command_lease(command, std::move(reply)); });
}

Result<std::unique_ptr<HeldLease>> HeldLease::take(const Context& context, const api::LeaseCommand& command) {
  Result<api::LeaseState> lease = command_lease(context, command);
  if (command.action == api::LeaseAction::kRequest) {
    lease = wait_for_answer(context, std::move(lease));
  }
  if (!lease) {
    return tl::unexpected<Error>(lease.error());
  }
  return std::unique_ptr<HeldLease>(new HeldLease(context, lease->epoch));
}

HeldLease::~HeldLease() {
  const Context undisturbed = calm(context_);
  if (const auto released = command_lease(undisturbed, {api::LeaseAction::kRelease, false}); !released) {
    say(context_, "the lease could not be given back: " + released.error().message);
  }
}

api::DriveCommand HeldLease::command(const Twist2& velocity) {
  return {velocity, kCommandLife, epoch_, ++sequence_, std::nullopt};
}

Result<api::LeaseState> HeldLease::check() {
  Result<api::LeaseState> lease = lease_of(context_);
  if (lease && lease->owner == context_.client_name && lease->stale) {
    lease = command_lease(context_, {api::LeaseAction::kAcquire, false});
  }
  if (lease && lease->owner != context_.client_name) {
    return fail(Errc::kRefused, lease->owner.empty() ? "nobody holds the lease now; acquire it again"
                                                     : "'" + lease->owner +
                                                           "' holds the lease now; ask for it with 'seeker lease "
                                                           "request'");
  }
  if (lease && lease->epoch != epoch_) {
    epoch_ = lease->epoch;
    sequence_ = 0;
  }
  return lease;
}

}  // namespace seeker::cli
