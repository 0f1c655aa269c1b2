#include "server/slam/unseen_motion.hpp"

#include "server/slam/local_cloud.hpp"

namespace seeker::slam {

bool UnseenMotion::is_silent(const Pose2& increment) const {
  return !moved({}, increment, params_.still_m, params_.still_rad);
}

UncertainPose UnseenMotion::expected(double dt_s) const {
  const double displacement_sigma_m = params_.speed_sigma_mps * dt_s;
  const double rotation_sigma_rad = params_.rotation_sigma_radps * dt_s;
  return {{x_mps_ * dt_s, y_mps_ * dt_s, rotation_radps_ * dt_s},
          Eigen::Vector3d(displacement_sigma_m, displacement_sigma_m, rotation_sigma_rad).cwiseAbs2().asDiagonal()};
}

bool UnseenMotion::is_too_fast(const Pose2& motion, double dt_s) const {
  return moved({}, motion, params_.max_speed_mps * dt_s, params_.max_rotation_radps * dt_s);
}

void UnseenMotion::note_wheels() {
  *this = UnseenMotion(params_);
  trusted_ = true;
}

void UnseenMotion::note(const Pose2& motion, double dt_s) {
  on_ = true;
  trusted_ = false;
  if (dt_s > 0.0) {
    x_mps_ = motion.x_m / dt_s;
    y_mps_ = motion.y_m / dt_s;
    rotation_radps_ = motion.theta_rad / dt_s;
  }
}

}  // namespace seeker::slam
