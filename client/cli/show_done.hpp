/// \file
/// The output of a verb that changes the state of a robot and returns no data.
#pragma once

#include <string>

#include "client/cli/verbs.hpp"

namespace seeker::cli {

/// Prints `done`, with --json as {"ok": true, "message": done}, if `ok` holds no error.
[[nodiscard]] VerbResult show_done(const Context& context, const Status& ok, const std::string& done);

}  // namespace seeker::cli
