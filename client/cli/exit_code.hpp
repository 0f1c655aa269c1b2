/// \file
/// Exit codes of `seeker`, for scripts.
#pragma once

#include <cstdint>

#include "common/api/mission.hpp"
#include "common/core/result.hpp"

namespace seeker::cli {

enum class ExitCode : std::uint8_t {
  kOk = 0,
  kFailed = 1,
  kUsage = 2,           ///< the command line, or a file or target that it names, is wrong or absent
  kRefused = 3,         ///< the robot refuses the request
  kNoLink = 4,          ///< no robot answers, or the connection broke for good
  kTimeout = 5,         ///< no answer, or no end of the mission, in time
  kTargetNotFound = 6,  ///< the search ended without a failure and without the target
  kInterrupted = 130,   ///< SIGINT
};

[[nodiscard]] ExitCode exit_code(Errc code);
/// Turns the error of a file that the command line names into a usage error where the file is absent, unreadable or
/// damaged. Other errors stay as they are.
[[nodiscard]] tl::unexpected<Error> fail_as_usage(Error error);
/// The exit code for a mission that has ended. A search that has reached its bound has not found its target; an
/// exploration that has reached its bound is complete.
[[nodiscard]] ExitCode exit_code(const api::MissionStatus& ended);

}  // namespace seeker::cli
