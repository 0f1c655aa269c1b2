/// \file
/// Calibrates wheels and laser of a robot from a drive: the parameters under which the motions by odometry are those
/// that the laser saw (Censi, Franchi, Marchionni and Oriolo, "Simultaneous calibration of odometry and sensor
/// parameters for mobile robots", IEEE Transactions on Robotics 29(2), 2013, as one weighted least-squares problem).
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "common/core/result.hpp"
#include "server/calibration/drive_legs.hpp"
#include "server/slam/odometry_tracker.hpp"

namespace seeker::calibration {

/// What is asked of a drive. The other parameters are kept near their start, with a prior.
enum class CalibrationSubject : std::uint8_t { kWheels, kMount };

struct DriveCalibrationParams {
  slam::OdometryParams odometry;      ///< random errors of the odometry, for the weights
  double wheel_prior_sigma = 0.02;    ///< of each of the three scales where the mount is asked for
  double mount_prior_sigma_m = 0.02;  ///< of the laser's place where the wheels are asked for
  double mount_prior_sigma_rad = 0.03;
  int max_iterations = 20;
  double stop = 1e-9;         ///< a step of all parameters below it has converged
  double huber_sigmas = 2.5;  ///< legs that deviate more (wheel slip, a wrong match) have a smaller weight
  std::size_t min_legs = 20;
  double least_rotation_rad = 0.1;  ///< legs with a larger rotation show the track and the lever arm of the laser
  double straight_m = 0.2;          ///< legs that are longer show the scale of the wheels and the heading of the laser
  double min_rotations_rad = 6.0;   ///< sum of the rotations of such legs, of either sign
  double min_straights_m = 5.0;     ///< sum of the lengths of such legs
  double max_scale_sigma = 0.01;    ///< a scale known less well is refused
  double max_mount_sigma_m = 0.03;
  double max_mount_sigma_rad = 0.03;
};

/// Parameters with what speaks for them.
struct DriveCalibrationResult {
  /// Order of the parameters in `covariance`.
  enum Parameter : Eigen::Index { kLeft, kRight, kTrack, kX, kY, kHeading, kParameters };
  using Matrix = Eigen::Matrix<double, kParameters, kParameters>;

  DriveCalibration calibration;
  Matrix covariance = Matrix::Zero();  ///< of the three scales, and of x, y (m) and heading (rad) of base_T_laser
  std::size_t legs = 0;
  std::size_t outliers = 0;    ///< legs with a smaller weight
  double spread = 0.0;         ///< of the residuals, over what the weights expect; about 1 where they are right
  double straights_m = 0.0;    ///< length of the legs that show the scales
  double rotations_rad = 0.0;  ///< rotation of the legs that show the track
  double rms_before_m = 0.0;   ///< motions by odometry against those by the laser, at the start
  double rms_before_rad = 0.0;
  double rms_after_m = 0.0;  ///< the same, calibrated
  double rms_after_rad = 0.0;

  [[nodiscard]] double sigma(Parameter parameter) const;
};

/// The calibration that explains the legs best, from `start`, which must be valid. kNotReady where the drive does not
/// show a parameter that is asked for, with what to drive instead.
[[nodiscard]] Result<DriveCalibrationResult> calibrate(const std::vector<DriveLeg>& legs, const DriveCalibration& start,
                                                       CalibrationSubject subject,
                                                       const DriveCalibrationParams& params = {});

}  // namespace seeker::calibration
