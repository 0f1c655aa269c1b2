#include "server/app/search_behaviour.hpp"

#include <algorithm>

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
  for (const api::TargetSpec& target : mission.targets) {
    request.targets.push_back({target.name, target.width_m, target.height_m, target.depth_m});
  }
  request.strategy = params.strategy.value_or(mission.mode == api::SearchMode::kPaper ? search::Strategy::kPaper
                                                                                      : search::Strategy::kPlan);
  request.on_found = to_search(mission.on_found);
  request.areas.bound = mission.bound;
  request.areas.keep_out = mission.keep_out;
  request.gaps_only = mission.gaps_only;
  return request;
}

std::vector<vision::TargetModel> target_models(const api::SearchMission& mission) {
  std::vector<vision::TargetModel> models;
  for (const api::TargetSpec& target : mission.targets) {
    models.push_back({.name = target.name,
                      .picture = target.picture,
                      .width_m = target.width_m,
                      .height_m = target.height_m,
                      .kind = target.recogniser == api::RecogniserKind::kFeatures ? vision::TargetKind::kFeature
                                                                                  : vision::TargetKind::kTemplate});
  }
  return models;
}

api::MissionEnd to_api(const search::SearchEnd& end, const std::vector<Point2>& unreachable) {
  api::MissionEnd out{
      .outcome = api::Outcome::kFault, .cause = end.cause, .remedy = end.remedy, .unreachable = unreachable};
  switch (end.kind) {
    case search::EndKind::kTargetFound: out.outcome = api::Outcome::kTargetFound; break;
    case search::EndKind::kNotFoundAreaCovered: out.outcome = api::Outcome::kNotFoundAreaCovered; break;
    case search::EndKind::kUnreachable: out.outcome = api::Outcome::kUnreachable; break;
    case search::EndKind::kUncertain: out.outcome = api::Outcome::kUncertain; break;
  }
  return out;
}

api::RangeSource to_api(search::RangeSource source) {
  switch (source) {
    case search::RangeSource::kNone: return api::RangeSource::kNone;
    case search::RangeSource::kSonar: return api::RangeSource::kSonar;
    case search::RangeSource::kLidar: return api::RangeSource::kLidar;
    case search::RangeSource::kTriangulation: return api::RangeSource::kTriangulation;
  }
  return api::RangeSource::kNone;
}

api::Detection to_api(const search::Detection& detection, const search::SearchRequest& request) {
  api::Detection out;
  out.id = detection.id;
  out.target = request.targets[static_cast<std::size_t>(detection.target)].name;
  out.stamp = detection.stamp;
  out.u_px = detection.u_px;
  out.v_px = detection.v_px;
  out.score = detection.score;
  out.map_T_base = detection.map_T_base;
  out.bearing_base_rad = detection.bearing_base_rad;
  out.bearing_map_rad = detection.bearing_map_rad;
  out.position = detection.position_map;
  out.position_covariance = detection.position_covariance;
  out.range_source = to_api(detection.range_source);
  out.sightings = detection.sightings;
  return out;
}

api::CoverageSummary to_api(const search::CoverageSummary& summary) {
  return {.reachable_area_m2 = summary.reachable_area_m2,
          .covered_area_m2 = summary.covered_area_m2,
          .threshold = summary.threshold,
          .mean_probability = summary.mean_probability,
          .gaps = summary.gaps};
}

}  // namespace

Result<std::unique_ptr<Behaviour>> SearchBehaviour::create(const SearchBehaviourParams& params,
                                                           const api::SearchMission& mission,
                                                           const std::shared_ptr<const search::ControlTable>& table,
                                                           EvidenceMemory memory,
                                                           std::unique_ptr<MapViewFinder> views) {
  Result<std::unique_ptr<vision::Recogniser>> recogniser =
      vision::make_recogniser(target_models(mission), params.recogniser);
  if (!recogniser) {
    return tl::unexpected<Error>(recogniser.error());
  }
  Result<search::SearchMission> core = search::SearchMission::create(to_search(params, mission), params.search, table);
  if (!core) {
    return tl::unexpected<Error>(core.error());
  }
  if (mission.gaps_only) {
    if (!memory->has_value()) {
      return fail(Errc::kNotReady, "there is no earlier search whose gaps could be searched; leave out --gaps-only");
    }
    core->keep_evidence(**memory);
  }
  return std::unique_ptr<Behaviour>(
      new SearchBehaviour(std::move(*core), std::shared_ptr<const vision::Recogniser>(std::move(*recogniser)),
                          std::move(memory), std::move(views)));
}

SearchBehaviour::SearchBehaviour(search::SearchMission mission, std::shared_ptr<const vision::Recogniser> recogniser,
                                 EvidenceMemory memory, std::unique_ptr<MapViewFinder> views)
    : mission_(std::move(mission)),
      recogniser_(std::move(recogniser)),
      memory_(std::move(memory)),
      views_(std::move(views)) {}

SearchBehaviour::~SearchBehaviour() {
  if (stepped_) {
    *memory_ = mission_.evidence();
  }
}

Decision SearchBehaviour::step(const Situation& situation) {
  stepped_ = true;
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
  if (step.end) {
    decision.end = to_api(*step.end, mission_.lists().unreachable);
  }
  return decision;
}

void SearchBehaviour::on_recognition(const Recognition& recognition) {
  mission_.on_sightings(recognition.stamp, recognition.map_T_base, recognition.sightings,
                        recognition.scan ? &*recognition.scan : nullptr,
                        recognition.sonar ? &*recognition.sonar : nullptr);
}

void SearchBehaviour::map_moved(const Pose2& new_T_old) {
  mission_.transform(new_T_old);
  if (views_) {
    views_->transform(new_T_old);
  }
}

void SearchBehaviour::resumed(RobotTime now) {
  mission_.pause();
  mission_.resume(now);
}

std::optional<api::GridReport> SearchBehaviour::grid() const {
  if (!stepped_) {
    return std::nullopt;
  }
  const search::GridLists& lists = mission_.lists();
  search::EvidenceReport evidence = mission_.evidence_report();
  api::GridReport report;
  report.lists = {.cell_size_m = lists.cell_size_m,
                  .searched = lists.searched,
                  .unsearched = lists.unsearched,
                  .unreachable = lists.unreachable,
                  .passes_n = lists.passes_n,
                  .passes_limit_n = lists.passes_limit_n};
  report.evidence.probability = std::move(evidence.probability);
  for (const search::Gap& gap : evidence.gaps) {
    report.evidence.gaps.push_back({gap.centre_map, gap.area_m2, gap.reason});
  }
  report.evidence.summary = to_api(evidence.summary);
  return report;
}

std::vector<api::Detection> SearchBehaviour::detections() const {
  std::vector<api::Detection> confirmed;
  for (const search::Detection& detection : mission_.detections()) {
    if (detection.confirmed) {
      confirmed.push_back(to_api(detection, mission_.request()));
    }
  }
  return confirmed;
}

}  // namespace seeker::app
