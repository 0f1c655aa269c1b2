/// \file
/// The answer of a verb that changes something and has no data to tell.
#pragma once

#include <string>

#include "client/cli/verbs.hpp"

namespace seeker::cli {

/// Prints `done`, as JSON {"ok": true, "message": done}, where it worked.
[[nodiscard]] VerbResult show_done(const Context& context, const Status& ok, const std::string& done);

}  // namespace seeker::cli
