/// \file
/// Perception brings what is found in pictures to those who asked: targets to the mission, landmarks to the estimator
/// and the mission.
#pragma once

#include <string>

#include "server/app/loop/cameras.hpp"
#include "server/app/loop/localiser.hpp"
#include "server/app/loop/sensing.hpp"
#include "server/app/missions/mission_executor.hpp"

namespace seeker::app {

/// Owns the cameras. Lives on the loop's thread.
class Perception {
 public:
  /// The references must outlive it.
  Perception(const Cameras::Parts& parts, const Sensing& sensing, Localiser& localiser, MissionExecutor& missions);

  /// Hands over what has been found in pictures since the last tick.
  void take_answers();
  /// Takes a picture, and has the running mission's recogniser look for its targets in it.
  void look_for_targets();
  /// Takes a stereo picture for the estimator and, where `for_mission`, for the mission as well.
  void look_with_both(bool for_mission);
  /// Takes one picture for a client. An unknown camera is kNotFound, and the message lists those that there are.
  [[nodiscard]] Result<api::ImageFrame> grab(const std::string& camera);

 private:
  void take_recognition();
  void take_look();
  void give_look(const Result<StereoLook>& look);

  Cameras cameras_;
  const Sensing& sensing_;
  Localiser& localiser_;
  MissionExecutor& missions_;
  bool mission_waits_ = false;  ///< for the result of a stereo observation
};

}  // namespace seeker::app
