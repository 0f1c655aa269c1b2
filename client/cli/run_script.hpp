/// \file
/// Plays a mission script against a robot.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "client/cli/context.hpp"
#include "client/cli/script.hpp"
#include "client/cli/verbs.hpp"

namespace seeker::cli {

/// How one step went.
struct StepReport {
  std::string kind;
  std::string outcome;  ///< of its mission, else empty
  std::string problem;  ///< which expectation failed; empty when all hold
  Duration robot = Duration::zero();
  Duration wall = Duration::zero();
};

/// Checks an expectation. `result` is what the step did: its mission's report, nothing for other steps, or its error.
[[nodiscard]] std::string unmet(const Expectation& expect, const Result<std::optional<MissionReport>>& result);

/// Says that a script is sound, as JSON with the keys of one that was played but without steps.
void print_check(const Context& context, const std::string& file, const Script& script);

/// Plays the steps in order up to the first whose expectation fails; prints a line (or JSON) a step. kOk only when
/// every expectation holds; Ctrl-C and a lost link end it with their own codes.
[[nodiscard]] VerbResult run_script(const Context& context, const Script& script, const std::filesystem::path& folder,
                                    const std::vector<std::filesystem::path>& target_folders);

}  // namespace seeker::cli
