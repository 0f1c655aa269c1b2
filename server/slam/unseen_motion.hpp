/// \file
/// Motion that the wheels do not report: a laser carried by hand, a log without odometry, a robot that is pushed.
#pragma once

#include "common/core/pose2.hpp"

namespace seeker::slam {

struct UnseenMotionParams {
  double still_m = 0.001;             ///< wheels that report less than this are silent
  double still_rad = 0.0005;          ///< and less rotation than this
  double speed_sigma_mps = 0.5;       ///< standard deviation of the speed around that of the last motion
  double rotation_sigma_radps = 0.8;  ///< standard deviation of the rate of rotation around that of the last motion
  double max_speed_mps = 2.0;         ///< upper limit of the speed with silent wheels
  double max_rotation_radps = 2.5;    ///< upper limit of the rate of rotation with silent wheels
};

/// Estimates the velocity while the wheels are silent: from the first motion that a scan shows and the wheels do not,
/// until the wheels report a motion again.
class UnseenMotion {
 public:
  explicit UnseenMotion(const UnseenMotionParams& params = {}) : params_(params) {}

  /// Whether wheels that report this motion (since the previous scan) are silent.
  [[nodiscard]] bool is_silent(const Pose2& increment) const;
  /// Whether silent wheels are known to be wrong.
  [[nodiscard]] bool on() const { return on_; }
  /// Whether silent wheels are known to be right: they have reported a motion, and no scan has contradicted them since.
  [[nodiscard]] bool trusted() const { return trusted_; }
  /// The motion to be expected in `dt_s` while the wheels are silent: the last velocity, in the frame of `base` at its
  /// beginning, with its covariance in that of its end.
  [[nodiscard]] UncertainPose expected(double dt_s) const;
  /// Whether the motion in `dt_s` exceeds the limits of the speed.
  [[nodiscard]] bool is_too_fast(const Pose2& motion, double dt_s) const;
  /// Adds the motion that a scan has shown while the wheels were silent for `dt_s`.
  void note(const Pose2& motion, double dt_s);
  /// Notes that the wheels reported a motion.
  void note_wheels();

 private:
  UnseenMotionParams params_;
  bool on_ = false;
  bool trusted_ = false;
  double x_mps_ = 0.0;
  double y_mps_ = 0.0;
  double rotation_radps_ = 0.0;
};

}  // namespace seeker::slam
