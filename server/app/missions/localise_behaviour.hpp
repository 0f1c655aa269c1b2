/// \file
/// Mission `localise`: finds the robot's place by the landmarks of a database, from no prior pose (spec S2.9; vision.md
/// 4.3).
#pragma once

#include <memory>

#include "common/core/rng.hpp"
#include "server/app/landmarks/landmark_library.hpp"
#include "server/app/missions/rotate_and_look.hpp"
#include "server/localize/stereo_localiser.hpp"

namespace seeker::app {

struct LocaliseSettings {
  RotateAndLookParams look;
  StereoGeometry geometry;
  localize::LocaliserParams localiser;
  std::string estimator_database;  ///< the one that the robot's estimator goes by; empty: it does not
};

class LocaliseBehaviour final : public Behaviour {
 public:
  /// kRefused: no stereo camera. Errors of the library and of localize::StereoLocaliser::create().
  [[nodiscard]] static Result<std::unique_ptr<Behaviour>> create(const LocaliseSettings& settings,
                                                                 const api::LocaliseMission& mission,
                                                                 const LandmarkLibrary& library,
                                                                 const Situation& situation);

  [[nodiscard]] Decision step(const Situation& situation) override;
  void on_look(const Result<StereoLook>& look) override;
  void resumed(RobotTime now) override;
  [[nodiscard]] bool needs_pose() const override { return false; }

 private:
  LocaliseBehaviour(const RotateAndLookParams& params, api::LocaliseMission mission,
                    localize::StereoLocaliser localiser, bool places_robot, std::string other_map,
                    const Situation& situation);
  void follow_odometry(const Situation& situation);
  void found(const Situation& situation, Decision& decision);

  api::LocaliseMission mission_;
  localize::StereoLocaliser localiser_;
  bool places_robot_;      ///< the pose found is one of the frame that the estimator works in
  std::string other_map_;  ///< that the landmarks were surveyed in, where it is known to be another than the robot's
  RotateAndLook sweep_;
  Rng rng_;
  std::optional<RobotTime> moved_at_;
  Pose2 odom_T_base_;
  int most_inliers_ = 0;
  std::string last_cause_;
};

}  // namespace seeker::app
