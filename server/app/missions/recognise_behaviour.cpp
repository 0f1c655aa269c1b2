#include "server/app/missions/recognise_behaviour.hpp"

#include <string>
#include <utility>

#include "server/app/missions/target_values.hpp"

namespace seeker::app {

Result<std::unique_ptr<Behaviour>> RecogniseBehaviour::create(const SearchBehaviourParams& params,
                                                              const api::RecogniseMission& mission,
                                                              std::shared_ptr<const vision::SolidModel> solids,
                                                              const Situation& situation) {
  Result<MissionRecogniser> recogniser = MissionRecogniser::make(mission.targets, params.recogniser, std::move(solids));
  if (!recogniser) {
    return tl::unexpected<Error>(recogniser.error());
  }
  return std::unique_ptr<Behaviour>(new RecogniseBehaviour(params, mission, std::move(*recogniser), situation));
}

RecogniseBehaviour::RecogniseBehaviour(const SearchBehaviourParams& params, const api::RecogniseMission& mission,
                                       MissionRecogniser recogniser, const Situation& situation)
    : targets_(search_targets(mission.targets)),
      recogniser_(std::move(recogniser)),
      tracker_(targets_, params.search.detection),
      round_(params.round) {
  round_.start(situation, mission.headings);
}

Decision RecogniseBehaviour::step(const Situation& situation) {
  Decision decision;
  decision.phase = "look";
  if (round_.active()) {
    decision.progress = static_cast<double>(round_.index()) / static_cast<double>(round_.headings());
    decision.activity =
        "looking into direction " + std::to_string(round_.index() + 1) + " of " + std::to_string(round_.headings());
    round_.step(situation, decision);
    return decision;
  }
  if (round_.started()) {
    const std::vector<Recognition> seen = round_.finish();
    pictures_ = seen.size();
    for (search::Look& look : to_looks(seen)) {
      look.pose_covariance = situation.pose.covariance;
      tracker_.add(look);
    }
  }
  decision.progress = 1.0;
  decision.end = end();
  return decision;
}

api::MissionEnd RecogniseBehaviour::end() const {
  const std::string pictures = std::to_string(pictures_) + (pictures_ == 1 ? " picture" : " pictures");
  if (pictures_ == 0) {
    return {.outcome = api::Outcome::kFault,
            .cause = "no picture came from the camera",
            .remedy = "check the camera with 'seeker camera grab' and 'seeker components'",
            .unreachable = {}};
  }
  std::string names;
  for (const search::Detection& detection : tracker_.detections()) {
    names += (names.empty() ? "'" : ", '") + targets_[static_cast<std::size_t>(detection.target)].name + "'";
  }
  if (names.empty()) {
    return {.outcome = api::Outcome::kComplete,
            .cause = "no target was recognised in " + pictures,
            .remedy = "",
            .unreachable = {}};
  }
  return {.outcome = api::Outcome::kTargetFound,
          .cause = "recognised " + names + " in " + pictures,
          .remedy = "",
          .unreachable = {}};
}

void RecogniseBehaviour::map_moved(const MapMove& move) {
  round_.map_moved(move);
  tracker_.transform(move);
}

void RecogniseBehaviour::resumed(RobotTime /*now*/) { round_.resumed(); }

std::vector<api::Detection> RecogniseBehaviour::detections() const {
  std::vector<api::Detection> out;
  for (const search::Detection& detection : tracker_.detections()) {
    out.push_back(to_api(detection, targets_));
  }
  return out;
}

}  // namespace seeker::app
