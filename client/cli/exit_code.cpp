#include "client/cli/exit_code.hpp"

#include <utility>

#include "common/core/assert.hpp"

namespace seeker::cli {

ExitCode exit_code(Errc code) {
  switch (code) {
    case Errc::kInvalidArgument:
    case Errc::kParse:
    case Errc::kTooLarge: return ExitCode::kUsage;
    case Errc::kRefused:
    case Errc::kBusy:
    case Errc::kNotReady:
    case Errc::kUnreachable:
    case Errc::kUnsupportedVersion: return ExitCode::kRefused;
    case Errc::kLinkLost: return ExitCode::kNoLink;
    case Errc::kTimeout: return ExitCode::kTimeout;
    case Errc::kCancelled: return ExitCode::kInterrupted;
    case Errc::kNotFound:
    case Errc::kCorrupt:
    case Errc::kIo:
    case Errc::kInternal: return ExitCode::kFailed;
  }
  return ExitCode::kFailed;
}

tl::unexpected<Error> fail_as_usage(Error error) {
  if (error.code == Errc::kNotFound || error.code == Errc::kCorrupt || error.code == Errc::kIo) {
    error.code = Errc::kInvalidArgument;
  }
  return tl::unexpected<Error>(std::move(error));
}

ExitCode exit_code(const api::MissionStatus& ended) {
  SEEKER_ASSERT(ended.end.has_value());
  switch (ended.end->outcome) {
    case api::Outcome::kComplete:
    case api::Outcome::kTargetFound: return ExitCode::kOk;
    case api::Outcome::kNotFoundAreaCovered: return ExitCode::kTargetNotFound;
    case api::Outcome::kBoundReached:
      return ended.kind == api::task_name(api::ExploreMission{}) ? ExitCode::kOk : ExitCode::kTargetNotFound;
    case api::Outcome::kTimeLimit: return ExitCode::kTimeout;
    case api::Outcome::kLinkLost: return ExitCode::kNoLink;
    case api::Outcome::kUnreachable:
    case api::Outcome::kUncertain:
    case api::Outcome::kLost:
    case api::Outcome::kBattery:
    case api::Outcome::kOperator:
    case api::Outcome::kFault: return ExitCode::kFailed;
  }
  return ExitCode::kFailed;
}

}  // namespace seeker::cli
