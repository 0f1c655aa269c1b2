#include "common/api/link_policy.hpp"

#include <algorithm>

#include "common/core/number_in.hpp"

namespace seeker::api {
namespace {

constexpr const char* kHowToWrite =
    "write seconds of silence and what to do then, as in 2:event,5:pause,30:return; there are event, pause, stop, "
    "return, finish-step and continue";

bool ends_list(LinkAction action) {
  return action == LinkAction::kStop || action == LinkAction::kReturn || action == LinkAction::kContinue;
}

std::optional<LinkAction> action_named(std::string_view name) {
  const auto* found = std::find_if(kLinkActions.begin(), kLinkActions.end(),
                                   [name](LinkAction action) { return to_string(action) == name; });
  return found != kLinkActions.end() ? std::optional(*found) : std::nullopt;
}

/// "5:pause".
std::optional<LinkStep> step_in(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) {
    return std::nullopt;
  }
  const auto after_s = finite_in(text.substr(0, colon));
  const auto action = action_named(text.substr(colon + 1));
  if (!after_s || !action || *after_s <= 0.0 || *after_s > to_seconds(kMaxLinkSilence)) {
    return std::nullopt;
  }
  return LinkStep{seconds(*after_s), *action};
}

LinkAction action_of(LinkPolicy policy) {
  switch (policy) {
    case LinkPolicy::kStop: return LinkAction::kStop;
    case LinkPolicy::kFinishStep: return LinkAction::kFinishStep;
    case LinkPolicy::kContinue: return LinkAction::kContinue;
    case LinkPolicy::kReturn: return LinkAction::kReturn;
  }
  return LinkAction::kStop;
}

}  // namespace

Status validate(const LinkSteps& steps) {
  if (steps.size() > kMaxLinkSteps) {
    return fail(Errc::kTooLarge, "a link policy has at most " + std::to_string(kMaxLinkSteps) + " entries");
  }
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (steps[i].after <= Duration::zero() || steps[i].after > kMaxLinkSilence) {
      return fail(Errc::kInvalidArgument, "a time of a link policy must be above zero and at most a day");
    }
    if (i > 0 && steps[i].after <= steps[i - 1].after) {
      return fail(Errc::kInvalidArgument, "each entry of a link policy must be later than the one before");
    }
    if (i > 0 && ends_list(steps[i - 1].action)) {
      return fail(Errc::kInvalidArgument, "nothing of a link policy can follow '" +
                                              std::string(to_string(steps[i - 1].action)) + "', which ends it");
    }
  }
  return {};
}

LinkSteps link_steps_of(LinkPolicy policy, Duration grace) { return {{grace, action_of(policy)}}; }

Result<LinkSteps> parse_link_steps(std::string_view text) {
  LinkSteps steps;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string_view entry = text.substr(begin, end - begin);
    const std::optional<LinkStep> step = step_in(entry);
    if (!step) {
      return fail(Errc::kInvalidArgument,
                  "'" + std::string(entry) + "' is no entry of a link policy; " + std::string(kHowToWrite));
    }
    steps.push_back(*step);
    begin = end + 1;
  }
  if (const Status ok = validate(steps); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  return steps;
}

std::string_view to_string(LinkPolicy policy) { return to_string(action_of(policy)); }

std::string_view to_string(LinkAction action) {
  switch (action) {
    case LinkAction::kEvent: return "event";
    case LinkAction::kPause: return "pause";
    case LinkAction::kStop: return "stop";
    case LinkAction::kReturn: return "return";
    case LinkAction::kFinishStep: return "finish-step";
    case LinkAction::kContinue: return "continue";
  }
  return "stop";
}

}  // namespace seeker::api
