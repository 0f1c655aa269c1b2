/// \file
/// Exit codes of `seeker`: what a script branches on.
#pragma once

#include <cstdint>

#include "common/api/mission.hpp"
#include "common/core/result.hpp"

namespace seeker::cli {

enum class ExitCode : std::uint8_t {
  kOk = 0,
  kFailed = 1,
  kUsage = 2,           ///< the command line, or a file or target that it names to be read, is wrong or not there
  kRefused = 3,         ///< the robot says no
  kNoLink = 4,          ///< nobody answers, or the connection broke for good
  kTimeout = 5,         ///< no answer, or no end, in time
  kTargetNotFound = 6,  ///< the search ended as it should, without the target
  kInterrupted = 130,   ///< SIGINT
};

[[nodiscard]] ExitCode exit_code(Errc code);
/// An error of something that the command line names to be read: absent, unreadable or damaged, it is the command line
/// that is wrong. What went wrong elsewhere stays what it is.
[[nodiscard]] tl::unexpected<Error> fail_as_usage(Error error);
/// Of a mission that has ended. A search that reached its bound has not found its target, an exploration is complete.
[[nodiscard]] ExitCode exit_code(const api::MissionStatus& ended);

}  // namespace seeker::cli
