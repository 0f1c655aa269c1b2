#include <nlohmann/json.hpp>

#include "client/cli/held_lease.hpp"
#include "client/cli/verbs.hpp"
#include "client/values/values_json.hpp"

namespace seeker::cli {
namespace {

constexpr Duration kCommandPeriod = std::chrono::milliseconds(100);

/// {"ok":true} or a sentence.
ExitCode done(const Context& context, std::string_view sentence) {
  if (context.json) {
    *context.out << json_line({{"ok", true}, {"message", sentence}}) << '\n';
  } else {
    say(context, sentence);
  }
  return ExitCode::kOk;
}

VerbResult finish(const Context& context, const Status& status, std::string_view sentence) {
  if (!status) {
    return tl::unexpected<Error>(status.error());
  }
  return done(context, sentence);
}

Result<std::unique_ptr<HeldLease>> take_lease(const Context& context, bool take_over) {
  return HeldLease::take(context, {take_over ? api::LeaseAction::kTakeOver : api::LeaseAction::kAcquire, take_over});
}

Status send_velocity(const Context& context, const Twist2& velocity, HeldLease& lease) {
  return ask<void>(context,
                   [&](api::Reply<void> reply) { context.robot->drive(lease.command(velocity), std::move(reply)); });
}

}  // namespace

VerbResult stop(const Context& context) {
  return finish(context, ask<void>(context, &api::RobotApi::stop), "stopped: mission and motion are ended");
}

VerbResult estop(const Context& context, const EstopVerb& verb) {
  const Status status =
      ask<void>(context, [&](api::Reply<void> reply) { context.robot->set_estop(!verb.release, std::move(reply)); });
  return finish(
      context, status,
      verb.release ? "the emergency stop is released" : "emergency stop: latched until seeker estop --release");
}

VerbResult command_mission(const Context& context, api::MissionCommand command) {
  const Status status =
      ask<void>(context, [&](api::Reply<void> reply) { context.robot->command_mission(command, std::move(reply)); });
  return finish(context, status,
                command == api::MissionCommand::kPause ? "paused; go on with seeker resume" : "resumed");
}

Result<std::string> drive_for(const Context& context, const Twist2& velocity, Duration duration, bool take_over) {
  const auto lease = take_lease(context, take_over);
  if (!lease) {
    return tl::unexpected<Error>(lease.error());
  }
  const auto start = std::chrono::steady_clock::now();
  for (auto next = start; next < start + duration; next += kCommandPeriod) {
    if (const Status sent = send_velocity(context, velocity, **lease); !sent) {
      return tl::unexpected<Error>(sent.error());
    }
    if (!sleep_for(context, next + kCommandPeriod - std::chrono::steady_clock::now())) {
      break;
    }
  }
  // Asked while the last command holds; whoever interrupts wants the robot to stand, and waits for no answer.
  const auto status = ask<api::RobotStatus>(context, &api::RobotApi::get_status);
  Context calm = context;
  calm.interrupted = [] { return false; };
  // Standing still is commanded, not waited for.
  const Status stopped = send_velocity(calm, {}, **lease);
  if (context.interrupted()) {
    return fail(Errc::kCancelled, "interrupted; the robot was commanded to stop");
  }
  if (!stopped || !status) {
    return tl::unexpected<Error>(!stopped ? stopped.error() : status.error());
  }
  return status->safety;
}

VerbResult drive(const Context& context, const DriveVerb& verb) {
  if (verb.v_m_s && verb.omega_rad_s) {
    const Twist2 velocity{*verb.v_m_s, *verb.omega_rad_s};
    const Result<std::string> held_back = drive_for(context, velocity, seconds(verb.for_s), verb.take_over);
    if (!held_back) {
      return tl::unexpected<Error>(held_back.error());
    }
    return done(context, held_back->empty() ? "drove and stopped" : "drove and stopped; held back: " + *held_back);
  }
  const auto lease = take_lease(context, verb.take_over);
  if (!lease) {
    return tl::unexpected<Error>(lease.error());
  }
  return finish(context, drive_by_keyboard(context, **lease), "the robot stands");
}

}  // namespace seeker::cli
