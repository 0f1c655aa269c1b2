/// \file
/// The outcome of a call, on the wire and as a value. The status enums of the responses share their names with Errc
/// (kNotFound = STATUS_NOT_FOUND = CODE_NOT_FOUND), so one rule serves all calls; a test holds them together.
#pragma once

#include <string>

#include "common/core/result.hpp"
#include "seeker/v1/calls.pb.h"

namespace seeker::wire {

/// Field number of a call: the same in Request and Response.
using CallNumber = int;

/// Writes success or failure: into the call's own status where it knows the code, else into the common error. The
/// result message of the call exists afterwards.
void set_outcome(seeker::v1::Response& response, CallNumber call, const Status& outcome);
/// A common error without a call's result, e.g. CODE_RATE_LIMITED.
void set_common_error(seeker::v1::Response& response, seeker::v1::CommonError::Code code, const std::string& message);
/// Reads the outcome of a response. A status that is absent or not known here is kInternal.
[[nodiscard]] Status outcome(const seeker::v1::Response& response);
/// Writes the common error alone, for protocols without a status of each call.
void set_error(seeker::v1::CommonError& error, const Status& outcome);
[[nodiscard]] Status status_of(const seeker::v1::CommonError& error);
/// Sets `code` to kInvalidArgument for STATUS_INVALID_ARGUMENT, and so on. False for OK, UNSPECIFIED and unknown names.
[[nodiscard]] bool errc_of(const std::string& enumerator, Errc& code);
/// "get_info" and so on; "unknown" for a number that is no call.
[[nodiscard]] std::string call_name(CallNumber call);

}  // namespace seeker::wire
