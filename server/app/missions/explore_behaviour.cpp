#include "server/app/missions/explore_behaviour.hpp"

#include <array>
#include <cstdio>
#include <utility>

#include "common/core/assert.hpp"

namespace seeker::app {
namespace {

api::Outcome to_api(explore::EndKind kind) {
  switch (kind) {
    case explore::EndKind::kComplete: return api::Outcome::kComplete;
    case explore::EndKind::kBoundReached: return api::Outcome::kBoundReached;
    case explore::EndKind::kUnreachable: return api::Outcome::kUnreachable;
    case explore::EndKind::kUncertain: return api::Outcome::kUncertain;
    case explore::EndKind::kBattery: return api::Outcome::kBattery;
    case explore::EndKind::kTimeLimit: return api::Outcome::kTimeLimit;
  }
  return api::Outcome::kFault;
}

std::optional<api::MissionEnd> to_api(std::optional<explore::ExploreEnd> end) {
  if (!end) {
    return std::nullopt;
  }
  return api::MissionEnd{.outcome = to_api(end->kind),
                         .cause = std::move(end->cause),
                         .remedy = std::move(end->remedy),
                         .unreachable = std::move(end->unreachable)};
}

api::Severity severity_of(const explore::ExploreEvent& event) {
  const bool trouble =
      event.kind == "uncertain" || event.kind == "battery" || event.kind == "time" || event.kind == "unreachable";
  return trouble ? api::Severity::kWarning : api::Severity::kInfo;
}

/// "(1.20, -0.45) m, score -2.61 of J1 -0.50 J21 -1.25 J22 -3.00, way 0.6 m"
std::string describe(const DecisionCandidate& c) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), "(%.2f, %.2f) m, score %.2f of J1 %.2f J21 %.2f J22 %.2f, way %.1f m",
                c.map_T_base.x_m, c.map_T_base.y_m, c.score, c.lg_j1, c.lg_j21, c.lg_j22, c.path_m);
  return text.data();
}

}  // namespace

explore::StrategyMaker maker_of(api::ExploreStrategy strategy, const fleet::TopologicalParams& topology) {
  switch (strategy) {
    case api::ExploreStrategy::kActive: return explore::maker_of(explore::Strategy::kActive);
    case api::ExploreStrategy::kHorizon: return explore::maker_of(explore::Strategy::kHorizon);
    case api::ExploreStrategy::kTour: return explore::maker_of(explore::Strategy::kTour);
    case api::ExploreStrategy::kRoam: return explore::maker_of(explore::Strategy::kRoam);
    case api::ExploreStrategy::kFrontier: return explore::maker_of(explore::Strategy::kFrontier);
    case api::ExploreStrategy::kGain: return explore::maker_of(explore::Strategy::kGain);
    case api::ExploreStrategy::kTopological:
      return [topology](const explore::ExploreParams& params) -> std::unique_ptr<explore::ExploreStrategy> {
        return std::make_unique<fleet::TopologicalStrategy>(params, topology);
      };
  }
  SEEKER_ASSERT(false);
  return {};
}

Status check_map_grows(const Situation& situation) {
  if (situation.tracker == nullptr) {
    return fail(Errc::kRefused,
                "this robot's estimator keeps no map of segments that could be explored; start it with "
                "--set estimator=line_slam");
  }
  if (situation.map_is_read_only) {
    return fail(Errc::kRefused, "the robot only localises in its map, which does not grow; load it without --localise");
  }
  return {};
}

std::string describe(const ExploreDecision& decision) {
  std::string text = std::to_string(decision.number) + " " + decision.rule + ": " + decision.why;
  if (decision.chosen && *decision.chosen < decision.candidates.size()) {
    text += "; to " + describe(decision.candidates[*decision.chosen]);
  }
  return text + "; " + std::to_string(decision.candidates.size()) + " candidates";
}

Result<std::unique_ptr<Behaviour>> ExploreBehaviour::create(const ExploreSettings& settings,
                                                            const api::ExploreMission& mission,
                                                            const Situation& situation) {
  if (const Status grows = check_map_grows(situation); !grows) {
    return tl::unexpected<Error>(grows.error());
  }
  explore::ExploreRequest request;
  request.strategy = maker_of(mission.strategy, settings.topology);
  request.areas.bound = mission.bound;
  request.areas.keep_out = mission.keep_out;
  request.return_to_start = mission.return_to_start;
  Result<explore::Exploration> core = explore::Exploration::create(request, settings.params);
  if (!core) {
    return tl::unexpected<Error>(core.error());
  }
  return std::unique_ptr<Behaviour>(new ExploreBehaviour(std::move(*core), seconds(settings.params.segments_period_s)));
}

void ExploreBehaviour::map_moved(const MapMove& move) {
  exploration_.transform(move);
  segments_.forget();
}

std::optional<api::MissionEnd> ExploreBehaviour::pending_end() const { return to_api(exploration_.pending_end()); }

Decision ExploreBehaviour::step(const Situation& situation) {
  SEEKER_ASSERT(situation.tracker != nullptr);
  const slam::MapTracker& tracker = *situation.tracker;
  const std::vector<MapSegment>& segments = segments_.of(tracker, situation.now);
  const std::optional<double> time_left_s =
      situation.time_left ? std::optional(to_seconds(*situation.time_left)) : std::nullopt;
  explore::ExploreStep step = exploration_.step({.now = situation.now,
                                                 .pose = situation.pose,
                                                 .velocity = situation.velocity,
                                                 .sonar = situation.sonar,
                                                 .laser = situation.scan,
                                                 .map = *situation.map,
                                                 .segments = segments,
                                                 .segments_revision = segments_.revision(),
                                                 .belief = tracker.local_belief(),
                                                 .battery_v = situation.battery_v,
                                                 .fleet = situation.fleet,
                                                 .movers = situation.movers,
                                                 .time_left_s = time_left_s});
  Decision decision;
  decision.command = step.command;
  decision.step_done = step.step_done;
  decision.phase = std::move(step.phase);
  decision.activity = std::move(step.activity);
  decision.progress = step.progress;
  decision.planned_path = std::move(step.planned_path);
  for (explore::ExploreEvent& event : step.events) {
    const api::Severity severity = severity_of(event);
    decision.events.push_back({std::move(event.kind), std::move(event.text), severity});
  }
  if (step.decision) {
    decision.events.push_back({"decision", describe(*step.decision), api::Severity::kInfo});
    decision.exploration = std::move(step.decision);
  }
  decision.end = to_api(std::move(step.end));
  return decision;
}

}  // namespace seeker::app
