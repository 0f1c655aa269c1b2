// The missions that tests of conversions are made of.

#include "tests/unit/common/wire/generators.hpp"

namespace seeker::testing {

std::vector<api::TargetSpec> ValueMaker::targets() {
  std::vector<api::TargetSpec> out;
  for (int k = count(3); k > 0; --k) {
    api::TargetSpec target{text(), {}, number(), number(), number(), one_of(api::RecogniserKind::kSolid)};
    if (target.recogniser == api::RecogniserKind::kSolid) {
      target.solid = one_of(kSolidKinds.back());
    } else {
      target.picture = image();
    }
    out.push_back(std::move(target));
  }
  return out;
}

api::LinkSteps ValueMaker::link_steps() {
  api::LinkSteps steps;
  for (int k = count(4); k > 0; --k) {
    steps.push_back(link_step());
  }
  return steps;
}

api::LinkCountdown ValueMaker::link_countdown() {
  api::LinkCountdown countdown{std::chrono::milliseconds(count(9000)), std::nullopt, {}};
  if (flag()) {
    countdown.next = link_step();
    countdown.left = std::chrono::milliseconds(count(9000));
  }
  return countdown;
}

api::MissionRequest ValueMaker::mission() {
  api::MissionRequest m;
  m.id = "m-" + std::to_string(count(99));
  m.link_policy = one_of(api::LinkPolicy::kReturn);
  if (flag()) {
    m.time_limit = Duration(count(1'000'000));
  }
  m.link_steps = link_steps();
  switch (count(6)) {
    case 0: {
      api::SearchMission search;
      search.targets = targets();
      search.mode = one_of(api::SearchMode::kPlan);
      search.on_found = one_of(api::OnFound::kContinue);
      if (flag()) {
        search.bound = points();
      }
      search.keep_out = {points(), points()};
      search.gaps_only = flag();
      search.explore = flag();
      m.task = search;
      break;
    }
    case 1: {
      api::GotoMission go{points(), {}, {points()}};
      if (flag()) {
        go.final_heading_rad = number();
      }
      m.task = go;
      break;
    }
    case 2: {
      api::ExploreMission explore{one_of(api::kExploreStrategies.back()), {}, {points()}, flag()};
      if (flag()) {
        explore.bound = points();
      }
      m.task = explore;
      break;
    }
    case 3: m.task = api::SurveyMission{text(), points(), count(99), flag(), {points()}}; break;
    case 4: m.task = api::LocaliseMission{text(), count(99)}; break;
    case 5: m.task = api::RecogniseMission{targets(), count(99)}; break;
    default: m.task = api::ReturnMission{flag() ? std::optional(points()) : std::nullopt, {points()}};
  }
  return m;
}

api::MissionStatus ValueMaker::mission_status() {
  api::MissionStatus m;
  m.id = text();
  m.kind = text();
  m.state = one_of(api::MissionState::kEnded);
  m.phase = text();
  m.activity = text();
  m.progress = rng_.uniform();
  m.started = time();
  m.updated = time();
  m.path_length_m = number();
  m.cells_searched = count(99);
  m.cells_unsearched = count(99);
  if (flag()) {
    m.coverage = coverage();
  }
  m.planned_path = points();
  m.link_policy = one_of(api::LinkPolicy::kReturn);
  m.link_steps = link_steps();
  if (flag()) {
    m.decision = decision();
  }
  if (m.state == api::MissionState::kEnded) {
    m.end = api::MissionEnd{one_of(api::Outcome::kFault), text(), text(), {}};
    for (int k = count(4); k > 0; --k) {
      m.end->unreachable.push_back({point(), one_of(kUnreachableCauses.back()), number(), text()});
    }
  }
  return m;
}

}  // namespace seeker::testing
