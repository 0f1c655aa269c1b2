/// \file
/// Mission scripts: steps with expectations, so that a script is a test (format in docs/client.md).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "common/api/mission.hpp"
#include "common/core/polygon.hpp"
#include "common/core/pose2.hpp"

namespace seeker::cli {

struct SearchStep {
  std::vector<std::string> targets;  ///< as for `seeker search --target`; files relative to the script
  std::vector<std::string> solids;   ///< as for `seeker search --solid`
  std::string recogniser;            ///< empty: as the targets' files say
  api::SearchMode mode = api::SearchMode::kPlan;
  api::OnFound on_found = api::OnFound::kApproach;
  std::optional<Polygon> bound;
  std::vector<Polygon> keep_out;
  bool gaps_only = false;
  bool explore = false;
};
struct ExploreStep {
  api::ExploreStrategy strategy = api::kDefaultExploreStrategy;
  std::optional<Polygon> bound;
  std::vector<Polygon> keep_out;
  bool return_to_start = false;
};
struct GotoStep {
  std::vector<Point2> waypoints;
  std::optional<double> heading_rad;
  std::vector<Polygon> keep_out;
};
struct SurveyStep {
  std::string landmarks;
  std::vector<Point2> places;
  int headings = 12;
  bool replace = false;
  std::vector<Polygon> keep_out;
};
struct LocaliseStep {
  std::string landmarks;
  int headings = 12;
};
struct RecogniseStep {
  std::vector<std::string> targets;  ///< as in SearchStep
  std::vector<std::string> solids;
  std::string recogniser;
  int headings = 1;
};
struct ReturnStep {};
/// Waits for the end of a mission that an earlier step started in the background.
struct AwaitStep {};
struct WaitStep {
  Duration wall = Duration::zero();
};
struct DriveStep {
  Twist2 velocity;
  Duration duration = std::chrono::seconds(1);
};
struct CommandStep {
  api::MissionCommand command = api::MissionCommand::kPause;
};
struct EstopStep {
  bool release = false;
};
struct ExportStep {
  std::string name;
};
/// Waits until robots of the fleet have joined their maps.
struct FleetStep {
  int merged = 2;                            ///< so many, the main one included
  Duration limit = std::chrono::minutes(2);  ///< longest wait, wall time
};

using StepAction = std::variant<SearchStep, ExploreStep, GotoStep, SurveyStep, LocaliseStep, RecogniseStep, ReturnStep,
                                AwaitStep, WaitStep, DriveStep, CommandStep, EstopStep, ExportStep, FleetStep>;

/// Conditions that must hold after a step. Empty fields are not checked.
struct Expectation {
  std::string outcome;             ///< outcome of the mission, e.g. TARGET_FOUND
  std::optional<Duration> within;  ///< robot time of the mission; it is stopped when it takes longer
  std::string error;               ///< the step must fail with this code, e.g. refused
  std::vector<std::string> found;  ///< names of targets among the detections
  std::optional<double> covered;   ///< least covered share of the reachable floor, 0..1
};

struct Step {
  std::string kind;  ///< "search", "goto", ... as in the file
  StepAction action;
  bool background = false;  ///< true, for a mission: the next step begins while it runs
  api::LinkPolicy link_policy = api::LinkPolicy::kStop;
  api::LinkSteps link_steps;  ///< empty: link_policy
  std::optional<Duration> time_limit;
  Expectation expect;
};

struct Script {
  std::string name;
  std::filesystem::path robot;  ///< the robot file that the script was written for; empty: any robot
  std::filesystem::path world;  ///< the world file that it was written for; empty: that of the robot file
  int robots = 1;               ///< robots of one world that play it at the same time, each from its own client
  std::vector<Step> steps;
};

inline constexpr std::size_t kMaxSteps = 1000;
inline constexpr int kMaxRobots = 16;

/// Reads a script; errors name file, line and path. No other file is opened: `robot` and `world` stay as written, and
/// check_missions() loads the targets.
[[nodiscard]] Result<Script> parse_script(std::string_view text, const std::string& name);
/// Reads a script file; `robot` and `world` become paths that do not depend on its folder. Errors: those of
/// parse_script(), kNotFound where the script names a robot or world file that is not there.
[[nodiscard]] Result<Script> load_script(const std::filesystem::path& path);

/// Whether the step starts a mission.
[[nodiscard]] bool is_mission(const StepAction& action);
/// The mission of a step, with its targets loaded.
[[nodiscard]] Result<api::MissionRequest> make_request(const Step& step, const std::filesystem::path& script_folder,
                                                       const std::vector<std::filesystem::path>& target_folders);
/// Loads every target and validates every mission; the error names the step.
[[nodiscard]] Status check_missions(const Script& script, const std::filesystem::path& script_folder,
                                    const std::vector<std::filesystem::path>& target_folders);

}  // namespace seeker::cli
