/// \file
/// Perception brings what is found in pictures to those who asked: targets to the mission, landmarks to the estimator
/// and the mission, features of nodes to the fleet.
#pragma once

#include <cstdint>
#include <string>

#include "server/app/loop/cameras.hpp"
#include "server/app/loop/localiser.hpp"
#include "server/app/loop/loop_params.hpp"
#include "server/app/loop/neighbours.hpp"
#include "server/app/loop/sensing.hpp"
#include "server/app/missions/mission_executor.hpp"

namespace seeker::app {

/// The work done for the fleet's pictures so far.
struct PictureWork {
  std::uint64_t pictures = 0;  ///< pictures whose features were extracted
  std::uint64_t features = 0;  ///< features of all of them
  std::uint64_t kept = 0;      ///< pictures that were taken at nodes and kept
};

/// Owns the cameras. Lives on the loop's thread.
class Perception {
 public:
  /// The references must outlive it.
  Perception(const Cameras::Parts& parts, const NodePictureParams& pictures, const Sensing& sensing,
             Localiser& localiser, MissionExecutor& missions);

  /// Hands over what has been found in pictures since the last tick.
  void take_answers();
  /// Takes a picture, and has the running mission's recogniser look for its targets in it.
  void look_for_targets();
  /// Takes a stereo picture for the estimator and, where `for_mission`, for the mission as well.
  void look_with_both(bool for_mission);
  /// Takes a picture for the fleet where the robot has made a node of its topology, or between nodes where the features
  /// of all frames are asked for (spec S4.5). Those of nodes are kept with `neighbours`.
  void look_for_fleet(Neighbours& neighbours, RobotTime now);
  [[nodiscard]] const PictureWork& picture_work() const { return picture_work_; }
  /// Takes one picture for a client. An unknown camera is kNotFound, and the message lists those that there are.
  [[nodiscard]] Result<api::ImageFrame> grab(const std::string& camera);

 private:
  void take_recognition();
  void take_look();
  void give_look(const Result<StereoLook>& look);
  void take_described(Neighbours& neighbours);

  Cameras cameras_;
  NodePictureParams pictures_;
  const Sensing& sensing_;
  Localiser& localiser_;
  MissionExecutor& missions_;
  bool mission_waits_ = false;  ///< for the result of a stereo observation
  RobotTime next_frame_;        ///< of PicturesAt::kFrames
  PictureWork picture_work_;
};

}  // namespace seeker::app
