#include "common/core/wheel_calibration.hpp"

#include <cmath>

#include "common/core/angle.hpp"

namespace seeker {
namespace {

constexpr double kSmallestScale = 0.5;
constexpr double kLargestScale = 2.0;
constexpr double kLargestTrack_m = 10.0;

bool is_scale(double scale) { return scale >= kSmallestScale && scale <= kLargestScale; }

/// Length of the chord of an arc over the length of the arc, which rotates by twice `half_rad`.
double chord_share(double half_rad) {
  constexpr double kSmallAngle = 1e-6;
  return std::abs(half_rad) > kSmallAngle ? std::sin(half_rad) / half_rad : 1.0;
}

}  // namespace

bool is_identity(const WheelCalibration& calibration) {
  return calibration.left_scale == 1.0 && calibration.right_scale == 1.0 && calibration.track_scale == 1.0;
}

Status validate(const WheelCalibration& calibration) {
  if (!is_scale(calibration.left_scale) || !is_scale(calibration.right_scale) || !is_scale(calibration.track_scale)) {
    return fail(Errc::kInvalidArgument, "left_scale, right_scale and track_scale must be from 0.5 to 2");
  }
  if (!(calibration.track_m > 0.0 && calibration.track_m <= kLargestTrack_m)) {
    return fail(Errc::kInvalidArgument, "track_m must be above 0 and at most 10");
  }
  return {};
}

Twist2 corrected(const Twist2& twist, const WheelCalibration& calibration) {
  const double half_difference_m_s = 0.5 * twist.omega_rad_s * calibration.track_m;
  const double left_m_s = calibration.left_scale * (twist.v_m_s - half_difference_m_s);
  const double right_m_s = calibration.right_scale * (twist.v_m_s + half_difference_m_s);
  return {0.5 * (left_m_s + right_m_s), (right_m_s - left_m_s) / (calibration.track_m * calibration.track_scale)};
}

Twist2 reported(const Twist2& twist, const WheelCalibration& calibration) {
  const double half_difference_m_s = 0.5 * twist.omega_rad_s * calibration.track_m * calibration.track_scale;
  const double left_m_s = (twist.v_m_s - half_difference_m_s) / calibration.left_scale;
  const double right_m_s = (twist.v_m_s + half_difference_m_s) / calibration.right_scale;
  return {0.5 * (left_m_s + right_m_s), (right_m_s - left_m_s) / calibration.track_m};
}

Pose2 corrected(const Pose2& increment, const WheelCalibration& calibration) {
  const double half_rad = 0.5 * wrap_angle(increment.theta_rad);
  const Point2 from_chord = Pose2{0.0, 0.0, -half_rad} * increment.translation();
  const Twist2 arc = corrected(Twist2{from_chord.x() / chord_share(half_rad), 2.0 * half_rad}, calibration);
  const double new_half_rad = 0.5 * arc.omega_rad_s;
  const Point2 moved = Pose2{0.0, 0.0, new_half_rad} * Point2(arc.v_m_s * chord_share(new_half_rad), from_chord.y());
  return {moved.x(), moved.y(), wrap_angle(arc.omega_rad_s)};
}

}  // namespace seeker
