/// \file
/// Plays a mission script against a robot.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "client/cli/context.hpp"
#include "client/cli/script.hpp"
#include "client/cli/verbs.hpp"
#include "common/api/fleet.hpp"

namespace seeker::cli {

/// The outcome of one step.
struct StepReport {
  std::string kind;
  std::string outcome;  ///< outcome of its mission; empty without one
  std::string problem;  ///< which expectation failed; empty when all hold
  Duration robot = Duration::zero();
  Duration wall = Duration::zero();
};

/// Checks an expectation and returns what does not hold, empty where all does. `result` is the report of the mission of
/// the step, std::nullopt for other steps, or the error of the step.
[[nodiscard]] std::string unmet(const Expectation& expect, const Result<std::optional<MissionReport>>& result);

/// Prints that a script is valid, as JSON with the keys of a script that was played but without steps.
void print_check(const Context& context, const std::string& file, const Script& script);

/// Asks the main robot of the fleet that the robot belongs to.
using FleetCall = std::function<Result<api::FleetStatus>()>;

/// Plays the steps in order up to the first whose expectation fails; prints a line (or JSON) a step. kOk only when
/// every expectation holds; Ctrl-C and a lost link end it with their own codes. `fleet` serves the steps of that name;
/// without it they fail.
[[nodiscard]] VerbResult run_script(const Context& context, const Script& script, const std::filesystem::path& folder,
                                    const std::vector<std::filesystem::path>& target_folders,
                                    const FleetCall& fleet = {});

}  // namespace seeker::cli
