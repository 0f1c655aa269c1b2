/// \file
/// Motion that no wheel tells of: a laser carried by hand, a log without odometry, a robot that is pushed.
#pragma once

#include "common/core/pose2.hpp"

namespace seeker::slam {

struct UnseenMotionParams {
  double still_m = 0.001;  ///< wheels that tell of less than this say nothing
  double still_rad = 0.0005;
  double speed_sigma_mps = 0.5;  ///< by which the speed may differ from that of the last motion
  double turn_sigma_radps = 0.8;
  double max_speed_mps = 2.0;  ///< nobody moves faster whose wheels say nothing
  double max_turn_radps = 2.5;
};

/// Follows how fast the robot moves while the wheels say nothing: from the first motion that a scan shows and the
/// wheels do not, until they tell of one again.
class UnseenMotion {
 public:
  explicit UnseenMotion(const UnseenMotionParams& params = {}) : params_(params) {}

  /// Whether wheels that tell of this motion (since the scan before) say nothing.
  [[nodiscard]] bool is_silent(const Pose2& increment) const;
  /// Whether wheels that say nothing are known to be wrong.
  [[nodiscard]] bool on() const { return on_; }
  /// Whether they are known to be right: they have told of a motion, and no scan of another since.
  [[nodiscard]] bool trusted() const { return trusted_; }
  /// What wheels that say nothing leave to be expected of `dt_s`: the last motion once more, in the frame of `base` at
  /// its beginning, with its covariance in that of its end.
  [[nodiscard]] UncertainPose expected(double dt_s) const;
  /// Whether nobody can have moved so in `dt_s`.
  [[nodiscard]] bool is_too_fast(const Pose2& motion, double dt_s) const;
  /// The wheels said nothing for `dt_s`, and a scan has shown this motion.
  void note(const Pose2& motion, double dt_s);
  /// The wheels told of a motion.
  void note_wheels();

 private:
  UnseenMotionParams params_;
  bool on_ = false;
  bool trusted_ = false;
  double x_mps_ = 0.0;
  double y_mps_ = 0.0;
  double turn_radps_ = 0.0;
};

}  // namespace seeker::slam
