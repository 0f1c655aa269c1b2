/// \file
/// The missions of a robot with a stereo camera: survey and localise.
#pragma once

#include <memory>

#include "server/app/composition/robot_options.hpp"
#include "server/app/landmarks/landmark_library.hpp"
#include "server/app/missions/behaviour.hpp"
#include "server/app/missions/survey_behaviour.hpp"
#include "server/app/runtime/devices.hpp"

namespace seeker::app {

class StereoMissions {
 public:
  /// `devices` has a stereo camera.
  StereoMissions(const RobotOptions& options, const Devices& devices, std::shared_ptr<LandmarkLibrary> landmarks);

  [[nodiscard]] Result<std::unique_ptr<Behaviour>> survey(const api::SurveyMission& mission,
                                                          const Situation& situation) const;
  [[nodiscard]] Result<std::unique_ptr<Behaviour>> localise(const api::LocaliseMission& mission,
                                                            const Situation& situation) const;

 private:
  SurveySettings settings_;
  localize::LocaliserParams localiser_;
  std::shared_ptr<LandmarkLibrary> landmarks_;
};

}  // namespace seeker::app
