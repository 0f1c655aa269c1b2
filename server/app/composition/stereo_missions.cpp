#include "server/app/composition/stereo_missions.hpp"

#include <utility>

#include "server/app/missions/localise_behaviour.hpp"

namespace seeker::app {

StereoMissions::StereoMissions(const RobotOptions& options, const Devices& devices,
                               std::shared_ptr<LandmarkLibrary> landmarks)
    : localiser_(options.stereo.localiser), landmarks_(std::move(landmarks)) {
  settings_.params = options.stereo.survey;
  settings_.go = options.go;
  settings_.geometry = devices.stereo->geometry();
  settings_.database = options.stereo.database;
  settings_.arm = localiser_.arm;
  settings_.eye_height_m = localiser_.eye_height_m;
  settings_.inline_work = devices.clock->lockstep();
}

Result<std::unique_ptr<Behaviour>> StereoMissions::survey(const api::SurveyMission& mission,
                                                          const Situation& situation) const {
  return SurveyBehaviour::create(settings_, mission, landmarks_, situation);
}

Result<std::unique_ptr<Behaviour>> StereoMissions::localise(const api::LocaliseMission& mission,
                                                            const Situation& situation) const {
  return LocaliseBehaviour::create({.look = settings_.params.look,
                                    .geometry = settings_.geometry,
                                    .localiser = localiser_,
                                    .estimator_database = landmarks_->in_use()},
                                   mission, *landmarks_, situation);
}

}  // namespace seeker::app
