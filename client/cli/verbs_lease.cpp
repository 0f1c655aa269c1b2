#include <nlohmann/json.hpp>

#include "client/cli/held_lease.hpp"
#include "client/cli/show_done.hpp"
#include "client/cli/verbs.hpp"
#include "client/values/values.hpp"
#include "client/values/values_json.hpp"

namespace seeker::cli {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr Duration kCheckPeriod = std::chrono::milliseconds(500);

ExitCode show(const Context& context, const api::LeaseState& lease) {
  if (context.json) {
    *context.out << json_line(Json{{"lease", lease}}) << '\n';
  } else {
    *context.out << text_of(lease) << '\n';
  }
  return ExitCode::kOk;
}

/// Until Ctrl-C or for the time of the verb; tells who asks meanwhile.
VerbResult hold(const Context& context, const api::LeaseCommand& command, const LeaseVerb& verb) {
  const auto held = HeldLease::take(context, command);
  if (!held) {
    return tl::unexpected<Error>(held.error());
  }
  say(context, "'" + context.client_name + "' holds the lease; Ctrl-C gives it back");
  const auto end = verb.for_s ? SteadyClock::now() + seconds(*verb.for_s) : SteadyClock::time_point::max();
  std::string asks;
  while (SteadyClock::now() < end && !context.interrupted()) {
    const Result<api::LeaseState> lease = (*held)->check();
    if (!lease && context.interrupted()) {
      break;
    }
    if (!lease) {
      return tl::unexpected<Error>(lease.error());
    }
    if (lease->requested_by != asks && !lease->requested_by.empty()) {
      say(context, "'" + lease->requested_by + "' asks for the lease; 'seeker --as " + context.client_name +
                       " lease grant' or 'deny' answers");
    }
    asks = lease->requested_by;
    if (!sleep_for(context, std::min<Duration>(kCheckPeriod, end - SteadyClock::now()))) {
      break;
    }
  }
  return show_done(context, {}, "the lease is given back");
}

VerbResult command(const Context& context, api::LeaseAction action) {
  const Result<api::LeaseState> lease = command_lease(context, {action, false});
  return lease ? VerbResult(show(context, *lease)) : tl::unexpected<Error>(lease.error());
}

}  // namespace

VerbResult lease(const Context& context, const LeaseVerb& verb) {
  switch (verb.action) {
    case LeaseVerbAction::kShow: {
      const auto status = ask<api::RobotStatus>(context, &api::RobotApi::get_status);
      return status ? VerbResult(show(context, status->lease)) : tl::unexpected<Error>(status.error());
    }
    case LeaseVerbAction::kAcquire: return hold(context, {api::LeaseAction::kAcquire, false}, verb);
    case LeaseVerbAction::kRequest: return hold(context, {api::LeaseAction::kRequest, false}, verb);
    case LeaseVerbAction::kTakeOver: return hold(context, {api::LeaseAction::kTakeOver, verb.yes}, verb);
    case LeaseVerbAction::kGrant: return command(context, api::LeaseAction::kGrant);
    case LeaseVerbAction::kDeny: return command(context, api::LeaseAction::kDeny);
    case LeaseVerbAction::kRelease: return command(context, api::LeaseAction::kRelease);
  }
  return fail(Errc::kInvalidArgument, "there is no such action on the lease");
}

}  // namespace seeker::cli
