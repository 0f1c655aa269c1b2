#include "server/app/missions/search_behaviour.hpp"

#include <algorithm>
#include <utility>

#include "common/api/fleet.hpp"
#include "server/app/missions/target_values.hpp"

namespace seeker::app {
namespace {

search::OnFound to_search(api::OnFound on_found) {
  switch (on_found) {
    case api::OnFound::kStop: return search::OnFound::kStop;
    case api::OnFound::kApproach: return search::OnFound::kApproach;
    case api::OnFound::kContinue: return search::OnFound::kContinue;
  }
  return search::OnFound::kStop;
}

search::SearchRequest to_search(const SearchBehaviourParams& params, const api::SearchMission& mission) {
  search::SearchRequest request;
  request.targets = search_targets(mission.targets);
  request.strategy = params.strategy.value_or(mission.mode == api::SearchMode::kPaper ? search::Strategy::kPaper
                                                                                      : search::Strategy::kPlan);
  request.on_found = to_search(mission.on_found);
  request.areas.bound = mission.bound;
  request.areas.keep_out = mission.keep_out;
  request.gaps_only = mission.gaps_only;
  return request;
}

api::MissionEnd to_api(const search::SearchEnd& end) {
  api::MissionEnd out{
      .outcome = api::Outcome::kFault, .cause = end.cause, .remedy = end.remedy, .unreachable = end.unreachable};
  switch (end.kind) {
    case search::EndKind::kTargetFound: out.outcome = api::Outcome::kTargetFound; break;
    case search::EndKind::kNotFoundAreaCovered: out.outcome = api::Outcome::kNotFoundAreaCovered; break;
    case search::EndKind::kUnreachable: out.outcome = api::Outcome::kUnreachable; break;
    case search::EndKind::kUncertain: out.outcome = api::Outcome::kUncertain; break;
  }
  return out;
}

api::CoverageSummary to_api(const search::CoverageSummary& summary) {
  return {.reachable_area_m2 = summary.reachable_area_m2,
          .covered_area_m2 = summary.covered_area_m2,
          .threshold = summary.threshold,
          .mean_probability = summary.mean_probability,
          .gaps = summary.gaps};
}

/// Both sides have a type of their own with the same fields.
template <class To, class From>
To convert_lists(const From& lists) {
  return {.cell_size_m = lists.cell_size_m,
          .searched = lists.searched,
          .unsearched = lists.unsearched,
          .unreachable = lists.unreachable,
          .passes_n = lists.passes_n,
          .passes_limit_n = lists.passes_limit_n};
}

api::GridLists to_api(const search::GridLists& lists) { return convert_lists<api::GridLists>(lists); }
search::GridLists from_api(const api::GridLists& lists) { return convert_lists<search::GridLists>(lists); }

}  // namespace

Result<std::unique_ptr<Behaviour>> SearchBehaviour::create(const SearchBehaviourParams& params,
                                                           const api::SearchMission& mission, const SearchTools& tools,
                                                           std::unique_ptr<MapViewFinder> views) {
  Result<MissionRecogniser> recogniser = MissionRecogniser::make(mission.targets, params.recogniser, tools.solids);
  if (!recogniser) {
    return tl::unexpected<Error>(recogniser.error());
  }
  search::SearchParams core_params = params.search;
  const bool sees_all_around = params.recogniser.view.omni.has_value();
  core_params.plan.look_while_moving = core_params.plan.look_while_moving && sees_all_around;
  Result<search::SearchMission> core =
      search::SearchMission::create(to_search(params, mission), core_params, tools.table);
  if (!core) {
    return tl::unexpected<Error>(core.error());
  }
  if (mission.gaps_only) {
    if (!tools.memory->has_value()) {
      return fail(Errc::kNotReady, "there is no earlier search whose gaps could be searched; leave out --gaps-only");
    }
    core->keep_evidence(**tools.memory);
  }
  std::unique_ptr<SearchBehaviour> behaviour(
      new SearchBehaviour(std::move(*core), std::move(*recogniser), tools.memory, std::move(views)));
  if (!sees_all_around) {
    behaviour->round_.emplace(params.round);
    behaviour->pictures_around_ = pictures_around(params.recogniser.view, params.round);
  }
  return std::unique_ptr<Behaviour>(std::move(behaviour));
}

SearchBehaviour::SearchBehaviour(search::SearchMission mission, MissionRecogniser recogniser, EvidenceMemory memory,
                                 std::unique_ptr<MapViewFinder> views)
    : mission_(std::move(mission)),
      recogniser_(std::move(recogniser)),
      memory_(std::move(memory)),
      views_(std::move(views)) {}

SearchBehaviour::~SearchBehaviour() {
  if (stepped_) {
    *memory_ = mission_.evidence();
  }
}

Decision SearchBehaviour::look_around(const Situation& situation) {
  Decision decision;
  decision.phase = "look";
  decision.activity =
      "looking around, direction " + std::to_string(round_->index() + 1) + " of " + std::to_string(round_->headings());
  decision.progress = mission_.progress();
  round_->step(situation, decision);
  return decision;
}

Decision SearchBehaviour::step(const Situation& situation) {
  stepped_ = true;
  place_map_ = situation.pose.map_T_base.translation();
  if (round_ && round_->active()) {
    return look_around(situation);
  }
  if (round_ && round_->started()) {
    const std::vector<Recognition> seen = round_->finish();
    mission_.on_looks(to_looks(seen));
  }
  receive(situation.fleet);
  const search::MapViews views =
      views_ ? search::MapViews([&] { return views_->find(situation); }) : search::MapViews();
  search::SearchStep step = mission_.step({.now = situation.now,
                                           .map_T_base = situation.pose.map_T_base,
                                           .covariance = situation.pose.covariance,
                                           .sonar = situation.sonar,
                                           .laser = situation.scan,
                                           .map = *situation.map,
                                           .map_epoch = situation.pose.map_epoch,
                                           .map_views = views});
  Decision decision;
  decision.command = step.command;
  decision.wants_image = step.wants_image;
  decision.phase = std::move(step.phase);
  decision.activity = std::move(step.activity);
  decision.progress = mission_.progress();
  decision.planned_path = std::move(step.planned_path);
  for (search::SearchEvent& event : step.events) {
    decision.step_done = decision.step_done || event.kind == "cell_searched";
    decision.events.push_back({std::move(event.kind), std::move(event.text), api::Severity::kInfo});
  }
  if (decision.wants_image && round_) {
    decision.wants_image = false;
    round_->start(situation, pictures_around_);
  }
  if (step.end) {
    decision.end = to_api(*step.end);
  }
  return decision;
}

void SearchBehaviour::receive(const FleetView* fleet) {
  const SharedSearch others = fleet != nullptr ? fleet->searched : nullptr;
  if (others != others_) {
    others_ = others;
    mission_.set_others(others ? *others : std::vector<SearchedFloor>());
  }
}

void SearchBehaviour::on_recognition(const Recognition& recognition) {
  if (round_) {
    round_->take(recognition);
    return;
  }
  mission_.on_sightings(recognition.stamp, recognition.map_T_base, recognition.sightings,
                        recognition.scan ? &*recognition.scan : nullptr,
                        recognition.sonar ? &*recognition.sonar : nullptr);
}

void SearchBehaviour::map_moved(const MapMove& move) {
  mission_.transform(move);
  if (round_) {
    round_->map_moved(move);
  }
  if (views_) {
    views_->transform(move);
  }
}

void SearchBehaviour::resumed(RobotTime now) {
  if (round_ && round_->started()) {
    // The robot may have been moved: the search asks for another one.
    static_cast<void>(round_->finish());
  }
  mission_.pause();
  mission_.resume(now);
}

MissionMemory SearchBehaviour::memory() const {
  SearchMemory search{mission_.evidence().own_looks(place_map_, api::kMaxFleetSearchedSide_cells),
                      to_api(mission_.lists())};
  if (!stepped_ || search.looks.empty()) {
    return {};
  }
  return {.topology = std::nullopt, .search = std::move(search)};
}

void SearchBehaviour::remember(const MissionMemory& memory) {
  if (memory.search) {
    mission_.take_back(memory.search->looks, from_api(memory.search->lists));
  }
}

std::optional<api::GridReport> SearchBehaviour::grid() const {
  if (!stepped_) {
    return std::nullopt;
  }
  search::EvidenceReport evidence = mission_.evidence_report();
  api::GridReport report;
  report.lists = to_api(mission_.lists());
  report.evidence.probability = std::move(evidence.probability);
  for (const search::Gap& gap : evidence.gaps) {
    report.evidence.gaps.push_back({gap.centre_map, gap.area_m2, gap.reason});
  }
  report.evidence.summary = to_api(evidence.summary);
  return report;
}

std::optional<SearchedFloor> SearchBehaviour::searched(const Point2& middle_map, int side_cells) const {
  if (mission_.request().gaps_only) {
    return std::nullopt;  // it goes on from the looks of earlier searches, which may have been for other targets
  }
  Grid<std::uint8_t> looks = mission_.evidence().own_looks(middle_map, side_cells);
  if (looks.empty()) {
    return std::nullopt;
  }
  SearchedFloor searched;
  searched.probability = std::make_shared<const Grid<std::uint8_t>>(std::move(looks));
  for (const search::SearchTarget& target : mission_.request().targets) {
    searched.targets.push_back(target.name);
  }
  return searched;
}

std::vector<api::Detection> SearchBehaviour::detections() const {
  std::vector<api::Detection> confirmed;
  for (const search::Detection& detection : mission_.detections()) {
    if (detection.confirmed) {
      confirmed.push_back(to_api(detection, mission_.request().targets));
    }
  }
  return confirmed;
}

}  // namespace seeker::app
