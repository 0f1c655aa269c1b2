/// \file
/// Link policies as values: what a robot does while the client that started its mission is silent.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/result.hpp"
#include "common/core/time.hpp"

namespace seeker::api {

/// What the robot does on its own when the client that started the mission is gone.
/// It is the short form of a list of LinkSteps.
enum class LinkPolicy : std::uint8_t { kStop, kFinishStep, kContinue, kReturn };

/// What the robot does after some silence of the client that started the mission.
enum class LinkAction : std::uint8_t {
  kEvent,       ///< an event in the mission's log, no more
  kPause,       ///< until the mission is resumed, or the next step of the policy is due
  kStop,        ///< ends the mission where the robot stands
  kReturn,      ///< back to the start along the travelled path, then ends
  kFinishStep,  ///< ends the mission when its present step is done
  kContinue,    ///< goes on without a client
};
/// All of them, in order.
inline constexpr std::array kLinkActions{LinkAction::kEvent,  LinkAction::kPause,      LinkAction::kStop,
                                         LinkAction::kReturn, LinkAction::kFinishStep, LinkAction::kContinue};

/// One entry of a link policy.
struct LinkStep {
  Duration after{};  ///< wall time of silence
  LinkAction action = LinkAction::kStop;

  friend bool operator==(const LinkStep&, const LinkStep&) = default;
};
inline constexpr std::size_t kMaxLinkSteps = 16;
inline constexpr Duration kMaxLinkSilence = std::chrono::hours(24);

/// A link policy as a list; empty: the short form says what to do.
using LinkSteps = std::vector<LinkStep>;

/// kInvalidArgument: a time is not above zero and at most a day, or not later than the one before, or an action follows
/// stop, return or continue, which end the list. kTooLarge: more than kMaxLinkSteps.
[[nodiscard]] Status validate(const LinkSteps& steps);
/// The list that the short form stands for: its action, due after `grace`.
[[nodiscard]] LinkSteps link_steps_of(LinkPolicy policy, Duration grace);
/// Reads "2:event,5:pause,30:return", seconds of silence and what to do then. kInvalidArgument says what is wrong.
[[nodiscard]] Result<LinkSteps> parse_link_steps(std::string_view text);

/// A link policy at work: the client that started the mission is silent. Wall time.
struct LinkCountdown {
  Duration silent{};             ///< since the client last sent something
  std::optional<LinkStep> next;  ///< the next entry of the policy; nothing: none is left
  Duration left{};               ///< until it is due

  friend bool operator==(const LinkCountdown&, const LinkCountdown&) = default;
};

[[nodiscard]] std::string_view to_string(LinkPolicy policy);
[[nodiscard]] std::string_view to_string(LinkAction action);

}  // namespace seeker::api
