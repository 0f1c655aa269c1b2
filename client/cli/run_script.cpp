#include "client/cli/run_script.hpp"

#include <algorithm>
#include <iomanip>

#include <nlohmann/json.hpp>

#include "client/cli/export_check.hpp"
#include "client/cli/scene.hpp"
#include "client/values/values.hpp"
#include "client/values/values_json.hpp"

namespace seeker::cli {
namespace {

using SteadyClock = std::chrono::steady_clock;
using StepResult = Result<std::optional<MissionReport>>;

/// A step that is no mission: nothing to report, or its error.
StepResult plain(const Status& status) {
  if (!status) {
    return tl::unexpected<Error>(status.error());
  }
  return std::optional<MissionReport>();
}

constexpr std::chrono::milliseconds kFleetPeriod(500);

/// Robots whose whole maps are in the joint one; the main robot's always is.
int merged_robots(const api::FleetStatus& fleet) {
  int merged = 0;
  for (const api::FleetMember& member : fleet.members) {
    const bool main = &member == &fleet.members.front();
    merged += main || (member.state == api::FleetState::kMerged && member.pieces_missing == 0) ? 1 : 0;
  }
  return merged;
}

/// Plays one step; remembers the mission in the background.
class Player {
 public:
  Player(const Context& context, const std::filesystem::path& folder,
         const std::vector<std::filesystem::path>& target_folders, const FleetCall& fleet)
      : context_(context),
        folder_(folder),
        target_folders_(target_folders),
        fleet_(fleet),
        start_(SteadyClock::now()) {}

  StepResult play(const Step& step) {
    step_ = &step;
    return std::visit(*this, step.action);
  }

  StepResult operator()(const SearchStep&) { return mission(); }
  StepResult operator()(const GotoStep&) { return mission(); }
  StepResult operator()(const ReturnStep&) { return mission(); }
  StepResult operator()(const ExploreStep&) { return mission(); }
  StepResult operator()(const SurveyStep&) { return mission(); }
  StepResult operator()(const LocaliseStep&) { return mission(); }
  StepResult operator()(const RecogniseStep&) { return mission(); }
  StepResult operator()(const AwaitStep&) {
    if (!background_) {
      return fail(Errc::kNotFound, "no mission was started in the background before this step");
    }
    MissionRun run = std::move(*background_);
    background_.reset();
    return follow(run);
  }
  StepResult operator()(const WaitStep& wait) const {
    if (!sleep_for(context_, wait.wall)) {
      return fail(Errc::kCancelled, "interrupted");
    }
    return std::optional<MissionReport>();
  }
  StepResult operator()(const DriveStep& drive) const {
    return plain(drive_for(context_, drive.velocity, drive.duration, false).map([](const std::string&) {}));
  }
  StepResult operator()(const CommandStep& step) const {
    return plain(ask<void>(
        context_, [&](api::Reply<void> reply) { context_.robot->command_mission(step.command, std::move(reply)); }));
  }
  StepResult operator()(const EstopStep& estop) const {
    return plain(ask<void>(
        context_, [&](api::Reply<void> reply) { context_.robot->set_estop(!estop.release, std::move(reply)); }));
  }
  StepResult operator()(const ExportStep& step) const {
    const auto files = export_map(context_, step.name);
    if (!files) {
      return tl::unexpected<Error>(files.error());
    }
    return std::optional<MissionReport>();
  }
  StepResult operator()(const FleetStep& step) const {
    if (!fleet_) {
      return fail(Errc::kNotReady, "nobody says where the main robot of the fleet is; give --main");
    }
    const auto end = SteadyClock::now() + step.limit;
    while (true) {
      const Result<api::FleetStatus> fleet = fleet_();
      const int merged = fleet ? merged_robots(*fleet) : 0;
      if (merged >= step.merged) {
        return std::optional<MissionReport>();
      }
      if (SteadyClock::now() >= end) {
        return fleet ? fail(Errc::kTimeout, std::to_string(merged) + " of " + std::to_string(step.merged) +
                                                " robots have joined their maps; 'seeker fleet status' says why")
                     : tl::unexpected<Error>(fleet.error());
      }
      if (!sleep_for(context_, kFleetPeriod)) {
        return fail(Errc::kCancelled, "interrupted");
      }
    }
  }

 private:
  StepResult mission() {
    const Result<api::MissionRequest> request = make_request(*step_, folder_, target_folders_);
    if (!request) {
      return tl::unexpected<Error>(request.error());
    }
    Result<MissionRun> run = MissionRun::start(context_, *request);
    if (!run) {
      return tl::unexpected<Error>(run.error());
    }
    if (step_->background) {
      background_ = std::move(*run);
      return std::optional<MissionReport>();
    }
    return follow(*run);
  }

  StepResult follow(MissionRun& run) const {
    FollowOptions options;
    options.robot = step_->expect.within;
    if (context_.timeout) {
      // --timeout limits the whole script: what is left of it, counted from the start of this mission.
      options.wall = run.elapsed() + std::max(Duration::zero(), *context_.timeout - (SteadyClock::now() - start_));
    }
    Result<MissionReport> report = run.follow(calls(), options);
    return report ? StepResult(std::move(*report)) : tl::unexpected<Error>(report.error());
  }

  /// Each call has its usual timeout; --timeout limits the whole script.
  [[nodiscard]] Context calls() const {
    Context calm = context_;
    calm.timeout.reset();
    return calm;
  }

  const Context& context_;
  const std::filesystem::path& folder_;
  const std::vector<std::filesystem::path>& target_folders_;
  const FleetCall& fleet_;
  SteadyClock::time_point start_;
  const Step* step_ = nullptr;
  std::optional<MissionRun> background_;
};

/// Nothing after it can be expected to work.
bool ends_script(const Error& error) { return error.code == Errc::kCancelled || error.code == Errc::kLinkLost; }

/// A file that a script may name; left out where it names none.
void add_path(Json& json, const char* key, const std::filesystem::path& file) {
  if (!file.empty()) {
    json[key] = file.string();
  }
}

void print_steps(const Context& context, const Script& script, const std::vector<StepReport>& reports, bool ok) {
  Json json = {{"script", script.name}, {"ok", ok}};
  add_path(json, "robot", script.robot);
  add_path(json, "world", script.world);
  if (script.robots > 1) {
    json["robots"] = script.robots;
  }
  json["steps_planned"] = script.steps.size();
  Json& steps = json["steps"] = Json::array();
  for (std::size_t i = 0; i < reports.size(); ++i) {
    steps.push_back({{"step", i + 1},
                     {"do", reports[i].kind},
                     {"ok", reports[i].problem.empty()},
                     {"outcome", reports[i].outcome},
                     {"problem", reports[i].problem},
                     {"robot_time_s", to_seconds(reports[i].robot)},
                     {"wall_time_s", to_seconds(reports[i].wall)}});
  }
  *context.out << json_line(json) << '\n';
}

void print_line(const Context& context, std::size_t number, const StepReport& report) {
  constexpr int kColumn = 12;
  *context.out << (report.problem.empty() ? "PASS " : "FAIL ") << number << " " << std::left << std::setw(kColumn)
               << report.kind << report.outcome;
  if (report.robot > Duration::zero()) {
    *context.out << fixed("  %.1f s robot", to_seconds(report.robot));
  }
  *context.out << fixed("  %.1f s wall", to_seconds(report.wall))
               << (report.problem.empty() ? "" : "  " + report.problem) << '\n'
               << std::flush;
}

std::string unmet_mission(const Expectation& expect, const MissionReport& report) {
  const api::MissionEnd& end = *report.status.end;
  const std::string outcome(to_string(end.outcome));
  const Duration robot = report.status.updated - report.status.started;
  if (report.overran || (expect.within && robot > *expect.within)) {
    return fixed("took %.1f s of robot time, ", to_seconds(robot)) +
           fixed("expected at most %.1f s", expect.within ? to_seconds(*expect.within) : 0.0);
  }
  const ExitCode code = exit_code(report.status);
  const bool ended_well = code == ExitCode::kOk || code == ExitCode::kTargetNotFound;
  if (expect.outcome.empty() ? !ended_well : expect.outcome != outcome) {
    return "ended with " + outcome + " (" + end.cause + ")" +
           (expect.outcome.empty() ? "" : ", expected " + expect.outcome);
  }
  for (const std::string& name : expect.found) {
    if (std::none_of(report.detections.begin(), report.detections.end(),
                     [&](const api::Detection& d) { return d.target == name; })) {
      return "'" + name + "' was not found";
    }
  }
  if (expect.covered) {
    const auto& coverage = report.status.coverage;
    const double share =
        coverage && coverage->reachable_area_m2 > 0.0 ? coverage->covered_area_m2 / coverage->reachable_area_m2 : 0.0;
    if (share < *expect.covered) {
      return fixed("covered a share of %.3f, ", share) + fixed("expected at least %.3f", *expect.covered);
    }
  }
  return "";
}

}  // namespace

std::string unmet(const Expectation& expect, const Result<std::optional<MissionReport>>& result) {
  if (!result) {
    const std::string code(to_string(result.error().code));
    if (expect.error == code) {
      return "";
    }
    return result.error().message + (expect.error.empty() ? "" : " (" + code + ", expected " + expect.error + ")");
  }
  if (!expect.error.empty()) {
    return "succeeded, expected the error " + expect.error;
  }
  if (*result) {
    return unmet_mission(expect, **result);
  }
  const bool about_mission = !expect.outcome.empty() || expect.within || !expect.found.empty() || expect.covered;
  return about_mission ? "no mission ended in this step, so nothing of one can be expected" : "";
}

void print_check(const Context& context, const std::string& file, const Script& script) {
  if (context.json) {
    print_steps(context, script, {}, true);
  } else {
    say(context, file + " is sound: " + count_of(script.steps.size(), "step"));
  }
}

VerbResult run_script(const Context& context, const Script& script, const std::filesystem::path& folder,
                      const std::vector<std::filesystem::path>& target_folders, const FleetCall& fleet) {
  // Told now, not after the mission whose map would be lost.
  for (const Step& step : script.steps) {
    const auto* exported = std::get_if<ExportStep>(&step.action);
    if (const Status free = exported != nullptr ? check_map_export(exported->name) : Status(); !free) {
      return fail_with_context("map_export", free.error());
    }
  }
  Player player(context, folder, target_folders, fleet);
  std::vector<StepReport> reports;
  bool ok = true;
  for (const Step& step : script.steps) {
    say(context,
        "step " + std::to_string(reports.size() + 1) + " of " + std::to_string(script.steps.size()) + ": " + step.kind);
    const auto start = SteadyClock::now();
    const StepResult result = player.play(step);
    StepReport report{step.kind, "", unmet(step.expect, result), Duration::zero(), SteadyClock::now() - start};
    if (result && *result) {
      report.outcome = to_string((*result)->status.end->outcome);
      report.robot = (*result)->status.updated - (*result)->status.started;
    }
    reports.push_back(report);
    ok = report.problem.empty();
    if (!context.json) {
      print_line(context, reports.size(), report);
    }
    if (!result && ends_script(result.error()) && !ok) {
      return tl::unexpected<Error>(result.error());
    }
    if (!ok) {
      break;
    }
  }
  if (context.json) {
    print_steps(context, script, reports, ok);
  } else {
    *context.out << (ok ? "PASS " : "FAIL ") << script.name << '\n';
  }
  return ok ? ExitCode::kOk : ExitCode::kFailed;
}

}  // namespace seeker::cli
