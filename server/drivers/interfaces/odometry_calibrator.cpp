#include "server/drivers/interfaces/odometry_calibrator.hpp"

namespace seeker::drivers {

OdometrySample OdometryCalibrator::apply(const OdometrySample& measured) {
  if (is_identity(calibration_)) {
    return measured;
  }
  odom_T_base_ = measured_T_base_
                     ? odom_T_base_ * corrected(inverse(*measured_T_base_) * measured.odom_T_base, calibration_)
                     : measured.odom_T_base;
  measured_T_base_ = measured.odom_T_base;
  OdometrySample sample = measured;
  sample.odom_T_base = odom_T_base_;
  sample.velocity = corrected(measured.velocity, calibration_);
  return sample;
}

}  // namespace seeker::drivers
