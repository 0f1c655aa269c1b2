/// \file
/// Estimator by a database of landmarks: odometry moves the pose, looks with the stereo camera correct it (spec S2.8,
/// S2.9).
#pragma once

#include <optional>
#include <vector>

#include "common/core/rng.hpp"
#include "server/app/estimator.hpp"
#include "server/localize/stereo_localiser.hpp"

namespace seeker::app {

struct LandmarkEstimatorParams {
  std::string database;                                   ///< name of the database of landmarks
  Duration look_period = std::chrono::milliseconds(500);  ///< between looks, robot time
  Duration odometry_gap = std::chrono::seconds(1);        ///< longer silence is a typed fault
};

/// The frame `map` is that of the database. Not for two threads at once.
class LandmarkEstimator final : public Estimator {
 public:
  LandmarkEstimator(localize::StereoLocaliser localiser, const LandmarkEstimatorParams& params, Rng rng);

  [[nodiscard]] Status on_odometry(const drivers::OdometrySample& sample) override;
  /// Walls say nothing here.
  [[nodiscard]] Status on_scan(const LaserScan& /*scan*/) override { return {}; }
  [[nodiscard]] bool wants_look(RobotTime now) const override;
  void look_begun(RobotTime stamp) override;
  void on_look(const Result<StereoLook>& look) override;
  [[nodiscard]] Status place_at(const PoseEstimate& place) override;
  [[nodiscard]] PoseEstimate estimate() const override;

 private:
  void catch_up();

  localize::StereoLocaliser localiser_;
  LandmarkEstimatorParams params_;
  Rng rng_;
  /// The one at which the localiser stands, and those after it: while a look is worked on the localiser waits at the
  /// time of its exposure, and catches up afterwards.
  std::vector<drivers::OdometrySample> samples_;
  bool looking_ = false;
  std::optional<RobotTime> looked_at_;
};

/// The velocities that lead from one pose of dead reckoning to another in tau_s > 0 seconds, along an arc.
[[nodiscard]] Twist2 mean_velocity(const Pose2& odom_T_from, const Pose2& odom_T_to, double tau_s);

}  // namespace seeker::app
