/// \file
/// The output of verbs that change the state of a robot and return no data, or write files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "client/cli/verbs.hpp"

namespace seeker::cli {

/// Prints `done`, with --json as {"ok": true, "message": done}, if `ok` holds no error.
[[nodiscard]] VerbResult show_done(const Context& context, const Status& ok, const std::string& done);

/// Prints the names of the files that were written, a line each, with --json as {"files": [...]}.
[[nodiscard]] VerbResult show_files(const Context& context, const Result<std::vector<std::filesystem::path>>& files);

}  // namespace seeker::cli
