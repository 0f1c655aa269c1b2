#include "client/cli/mission_run.hpp"
#include "client/cli/script.hpp"
#include "client/cli/targets.hpp"

namespace seeker::cli {
namespace {

namespace fs = std::filesystem;

/// A target's file in a script is relative to the script; a name is looked up as on the command line.
std::string target_path(const std::string& target, const fs::path& script_folder) {
  const bool is_file = fs::path(target).has_extension() || target.find('/') != std::string::npos;
  return is_file && fs::path(target).is_relative() ? (script_folder / target).string() : target;
}

/// Of a SearchStep or a RecogniseStep.
template <class What>
Result<std::vector<api::TargetSpec>> targets_of(const What& step, const fs::path& script_folder,
                                                const std::vector<fs::path>& target_folders) {
  std::vector<std::string> names;
  names.reserve(step.targets.size());
  for (const std::string& name : step.targets) {
    names.push_back(target_path(name, script_folder));
  }
  TargetDefaults defaults;
  defaults.recogniser = step.recogniser;
  return load_targets(names, step.solids, defaults, target_folders);
}

}  // namespace

bool is_mission(const StepAction& action) {
  return std::holds_alternative<SearchStep>(action) || std::holds_alternative<ExploreStep>(action) ||
         std::holds_alternative<GotoStep>(action) || std::holds_alternative<SurveyStep>(action) ||
         std::holds_alternative<LocaliseStep>(action) || std::holds_alternative<RecogniseStep>(action) ||
         std::holds_alternative<ReturnStep>(action);
}

Result<api::MissionRequest> make_request(const Step& step, const fs::path& script_folder,
                                         const std::vector<fs::path>& target_folders) {
  api::MissionRequest request;
  request.id = make_mission_id(step.kind);
  request.link_policy = step.link_policy;
  request.link_steps = step.link_steps;
  request.time_limit = step.time_limit;
  if (const auto* search = std::get_if<SearchStep>(&step.action)) {
    Result<std::vector<api::TargetSpec>> targets = targets_of(*search, script_folder, target_folders);
    if (!targets) {
      return tl::unexpected<Error>(targets.error());
    }
    api::SearchMission mission;
    mission.targets = std::move(*targets);
    mission.mode = search->mode;
    mission.on_found = search->on_found;
    mission.bound = search->bound;
    mission.keep_out = search->keep_out;
    mission.gaps_only = search->gaps_only;
    mission.explore = search->explore;
    request.task = std::move(mission);
  } else if (const auto* explore = std::get_if<ExploreStep>(&step.action)) {
    request.task = api::ExploreMission{explore->strategy, explore->bound, explore->keep_out, explore->return_to_start};
  } else if (const auto* go = std::get_if<GotoStep>(&step.action)) {
    request.task = api::GotoMission{go->waypoints, go->heading_rad, go->keep_out};
  } else if (const auto* survey = std::get_if<SurveyStep>(&step.action)) {
    request.task =
        api::SurveyMission{survey->landmarks, survey->places, survey->headings, survey->replace, survey->keep_out};
  } else if (const auto* localise = std::get_if<LocaliseStep>(&step.action)) {
    request.task = api::LocaliseMission{localise->landmarks, localise->headings};
  } else if (const auto* recognise = std::get_if<RecogniseStep>(&step.action)) {
    Result<std::vector<api::TargetSpec>> targets = targets_of(*recognise, script_folder, target_folders);
    if (!targets) {
      return tl::unexpected<Error>(targets.error());
    }
    request.task = api::RecogniseMission{std::move(*targets), recognise->headings};
  } else {
    request.task = api::ReturnMission{};
  }
  if (const Status ok = api::validate(request); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  return request;
}

Status check_missions(const Script& script, const fs::path& script_folder,
                      const std::vector<fs::path>& target_folders) {
  for (std::size_t i = 0; i < script.steps.size(); ++i) {
    const StepAction& action = script.steps[i].action;
    if (!is_mission(action)) {
      continue;
    }
    const Result<api::MissionRequest> request = make_request(script.steps[i], script_folder, target_folders);
    if (!request) {
      return fail_with_context("step " + std::to_string(i + 1) + " (" + script.steps[i].kind + ")", request.error());
    }
  }
  return {};
}

}  // namespace seeker::cli
