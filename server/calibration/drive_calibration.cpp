#include "server/calibration/drive_calibration.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "common/core/angle.hpp"
#include "server/slam/covariance.hpp"

namespace seeker::calibration {
namespace {

using Fit = DriveCalibrationResult;
using Vector = Eigen::Matrix<double, Fit::kParameters, 1>;
using Jacobian = Eigen::Matrix<double, 3, Fit::kParameters>;

constexpr double kMedianOfChi3 = 1.538;  ///< median of the length of a standard normal vector of three dimensions

Vector vector_of(const DriveCalibration& calibration) {
  Vector values;
  values << calibration.wheels.left_scale, calibration.wheels.right_scale, calibration.wheels.track_scale,
      calibration.base_T_laser.x_m, calibration.base_T_laser.y_m, calibration.base_T_laser.theta_rad;
  return values;
}

DriveCalibration calibration_of(const Vector& values, double track_m) {
  return {{track_m, values[Fit::kLeft], values[Fit::kRight], values[Fit::kTrack]},
          {values[Fit::kX], values[Fit::kY], wrap_angle(values[Fit::kHeading])}};
}

Pose2 driven(const DriveLeg& leg, const WheelCalibration& wheels) {
  Pose2 from_T_to;
  for (const Pose2& increment : leg.increments) {
    from_T_to = from_T_to * corrected(increment, wheels);
  }
  return from_T_to;
}

/// Motion of the laser as measured minus as computed from the odometry.
Eigen::Vector3d residual_of(const DriveLeg& leg, const DriveCalibration& calibration) {
  const Pose2& base_T_laser = calibration.base_T_laser;
  return offset_of(leg.from_T_to.a_T_b, inverse(base_T_laser) * driven(leg, calibration.wheels) * base_T_laser);
}

/// By central differences: the parameters are of the order of one, and the motions smooth.
Jacobian jacobian_of(const DriveLeg& leg, const Vector& at, double track_m) {
  constexpr double kStep = 1e-6;
  Jacobian jacobian;
  for (Eigen::Index k = 0; k < Fit::kParameters; ++k) {
    const Vector step = kStep * Vector::Unit(k);
    jacobian.col(k) =
        (residual_of(leg, calibration_of(at + step, track_m)) - residual_of(leg, calibration_of(at - step, track_m))) /
        (2.0 * kStep);
  }
  return jacobian;
}

/// Inverse covariance of the residual of a leg: of the match, and of the random errors of the odometry.
Matrix3 weight_of(const DriveLeg& leg, const DriveCalibration& calibration, const slam::OdometryParams& params) {
  UncertainPose from_T_to;
  for (const Pose2& increment : leg.increments) {
    from_T_to = compose(from_T_to, {increment, increment_covariance(increment, params)});
  }
  const UncertainPose seen = compose({inverse(calibration.base_T_laser), Matrix3::Zero()},
                                     compose(from_T_to, {calibration.base_T_laser, Matrix3::Zero()}));
  return slam::information_of(seen.covariance + leg.from_T_to.covariance);
}

struct Rms {
  double m = 0.0;
  double rad = 0.0;
};

Rms rms_of(const std::vector<DriveLeg>& legs, const DriveCalibration& calibration) {
  Rms sum;
  for (const DriveLeg& leg : legs) {
    const Eigen::Vector3d residual = residual_of(leg, calibration);
    sum.m += residual.head<2>().squaredNorm();
    sum.rad += residual[2] * residual[2];
  }
  const auto count = static_cast<double>(legs.size());
  return {std::sqrt(sum.m / count), std::sqrt(sum.rad / count)};
}

/// Normal equations of all legs with robust weights.
struct Equations {
  Fit::Matrix information = Fit::Matrix::Zero();
  Vector gradient = Vector::Zero();
  double spread = 1.0;
  std::size_t outliers = 0;
};

class Problem {
 public:
  Problem(const std::vector<DriveLeg>& legs, const DriveCalibration& start, CalibrationSubject subject,
          const DriveCalibrationParams& params)
      : legs_(legs), start_(vector_of(start)), track_m_(start.wheels.track_m), params_(params) {
    weights_.reserve(legs.size());
    for (const DriveLeg& leg : legs) {
      weights_.push_back(weight_of(leg, start, params.odometry));
    }
    Vector sigmas = Vector::Zero();
    if (subject == CalibrationSubject::kMount) {
      sigmas.head<3>().setConstant(params.wheel_prior_sigma);
    } else {
      sigmas.tail<3>() << params.mount_prior_sigma_m, params.mount_prior_sigma_m, params.mount_prior_sigma_rad;
    }
    prior_ = (sigmas.array() > 0.0).select(sigmas.array().square().inverse(), 0.0).matrix().asDiagonal();
  }

  [[nodiscard]] Equations equations_at(const Vector& values) const;
  [[nodiscard]] const Vector& start() const { return start_; }
  [[nodiscard]] double track_m() const { return track_m_; }

 private:
  /// Length of each residual in standard deviations as the weights expect them.
  [[nodiscard]] std::vector<double> sizes_at(const Vector& values) const;

  const std::vector<DriveLeg>& legs_;
  Vector start_;
  double track_m_;
  const DriveCalibrationParams& params_;
  std::vector<Matrix3> weights_;
  Fit::Matrix prior_;
};

std::vector<double> Problem::sizes_at(const Vector& values) const {
  const DriveCalibration calibration = calibration_of(values, track_m_);
  std::vector<double> sizes;
  sizes.reserve(legs_.size());
  for (std::size_t k = 0; k < legs_.size(); ++k) {
    const Eigen::Vector3d residual = residual_of(legs_[k], calibration);
    sizes.push_back(std::sqrt(residual.dot(weights_[k] * residual)));
  }
  return sizes;
}

Equations Problem::equations_at(const Vector& values) const {
  const std::vector<double> sizes = sizes_at(values);
  std::vector<double> sorted = sizes;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  constexpr double kSmallest = 1e-6;  // motions without any error
  Equations sum;
  sum.spread = std::max(*middle / kMedianOfChi3, kSmallest);
  const double limit = params_.huber_sigmas * kMedianOfChi3 * sum.spread;
  const DriveCalibration calibration = calibration_of(values, track_m_);
  for (std::size_t k = 0; k < legs_.size(); ++k) {
    sum.outliers += sizes[k] > limit ? 1 : 0;
    const double share = sizes[k] > limit ? limit / sizes[k] : 1.0;
    const Matrix3 weight = share / (sum.spread * sum.spread) * weights_[k];
    const Jacobian jacobian = jacobian_of(legs_[k], values, track_m_);
    sum.information += jacobian.transpose() * weight * jacobian;
    sum.gradient += jacobian.transpose() * weight * residual_of(legs_[k], calibration);
  }
  sum.information += prior_;
  sum.gradient += prior_ * (values - start_);
  return sum;
}

std::string text_of(const char* format, double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

/// Refuses drives that do not show what is asked for.
Status check_drive(const std::vector<DriveLeg>& legs, const DriveCalibrationParams& params, Fit& fit) {
  for (const DriveLeg& leg : legs) {
    double length_m = 0.0;
    double rotation_rad = 0.0;
    for (const Pose2& increment : leg.increments) {
      length_m += increment.x_m;
      rotation_rad += increment.theta_rad;
    }
    fit.straights_m += std::abs(length_m) >= params.straight_m ? std::abs(length_m) : 0.0;
    fit.rotations_rad += std::abs(rotation_rad) >= params.least_rotation_rad ? std::abs(rotation_rad) : 0.0;
  }
  fit.legs = legs.size();
  if (fit.rotations_rad < params.min_rotations_rad) {
    return fail(Errc::kNotReady, text_of("the drive turns by %.0f deg only, ", rad_to_deg(fit.rotations_rad)) +
                                     "which shows neither the track of the wheels nor the place of the laser; record "
                                     "a drive that also turns on the spot, both ways, several times");
  }
  if (fit.straights_m < params.min_straights_m) {
    return fail(Errc::kNotReady, text_of("only %.1f m of the drive are legs that go ahead, ", fit.straights_m) +
                                     "which shows neither the scale of the wheels nor the heading of the laser; "
                                     "record a drive that also goes straight ahead for several metres, a few times");
  }
  if (legs.size() < params.min_legs) {
    return fail(
        Errc::kNotReady,
        "the drive has " + std::to_string(legs.size()) +
            " legs on which the laser shows where it is, which is too few; record a longer drive, between walls "
            "within the reach of the laser");
  }
  return {};
}

Status check_certainty(const Fit& fit, CalibrationSubject subject, const DriveCalibrationParams& params) {
  const bool wheels = subject == CalibrationSubject::kWheels;
  const double scale_sigma = std::max({fit.sigma(Fit::kLeft), fit.sigma(Fit::kRight), fit.sigma(Fit::kTrack)});
  const double place_sigma_m = std::max(fit.sigma(Fit::kX), fit.sigma(Fit::kY));
  if (wheels && scale_sigma > params.max_scale_sigma) {
    return fail(Errc::kNotReady,
                text_of("the scales of wheels and track are known to %.1f %% only; ", 100.0 * scale_sigma) +
                    "record a longer drive with straight legs and turns on the spot");
  }
  if (!wheels && (place_sigma_m > params.max_mount_sigma_m || fit.sigma(Fit::kHeading) > params.max_mount_sigma_rad)) {
    return fail(Errc::kNotReady, text_of("the place of the laser is known to %.0f mm ", 1e3 * place_sigma_m) +
                                     text_of("and %.1f deg only; ", rad_to_deg(fit.sigma(Fit::kHeading))) +
                                     "record a longer drive with straight legs and turns on the spot");
  }
  return {};
}

}  // namespace

double DriveCalibrationResult::sigma(Parameter parameter) const { return std::sqrt(covariance(parameter, parameter)); }

Result<DriveCalibrationResult> calibrate(const std::vector<DriveLeg>& legs, const DriveCalibration& start,
                                         CalibrationSubject subject, const DriveCalibrationParams& params) {
  Fit fit;
  if (const Status ok = check_drive(legs, params, fit); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  const Problem problem(legs, start, subject, params);
  Vector values = problem.start();
  double largest_step = 1.0;
  for (int k = 0; k < params.max_iterations && largest_step > params.stop; ++k) {
    const Equations equations = problem.equations_at(values);
    const Vector step = -equations.information.ldlt().solve(equations.gradient);
    values += step;
    largest_step = step.cwiseAbs().maxCoeff();
  }
  const DriveCalibration found = calibration_of(values, problem.track_m());
  if (!values.allFinite() || !validate(found.wheels)) {
    return fail(Errc::kNotReady,
                "no calibration explains the drive: the motions by odometry and by the laser do not belong together; "
                "check the mount of the laser in the robot file and the clocks of both");
  }
  const Equations equations = problem.equations_at(values);
  fit.calibration = found;
  fit.covariance = equations.information.inverse();
  fit.spread = equations.spread;
  fit.outliers = equations.outliers;
  const Rms before = rms_of(legs, start);
  const Rms after = rms_of(legs, found);
  fit.rms_before_m = before.m;
  fit.rms_before_rad = before.rad;
  fit.rms_after_m = after.m;
  fit.rms_after_rad = after.rad;
  const Status certain = check_certainty(fit, subject, params);
  return certain ? Result<Fit>(fit) : Result<Fit>(tl::unexpected<Error>(certain.error()));
}

}  // namespace seeker::calibration
