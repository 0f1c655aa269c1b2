#include "common/core/pose2.hpp"

#include <cmath>
#include <ostream>

#include "common/core/angle.hpp"

namespace seeker {

Pose2 operator*(const Pose2& a_T_b, const Pose2& b_T_c) {
  const double c = std::cos(a_T_b.theta_rad);
  const double s = std::sin(a_T_b.theta_rad);
  return {a_T_b.x_m + b_T_c.x_m * c - b_T_c.y_m * s, a_T_b.y_m + b_T_c.x_m * s + b_T_c.y_m * c,
          wrap_angle(a_T_b.theta_rad + b_T_c.theta_rad)};
}

Point2 operator*(const Pose2& a_T_b, const Point2& p_b) {
  const double c = std::cos(a_T_b.theta_rad);
  const double s = std::sin(a_T_b.theta_rad);
  return {a_T_b.x_m + p_b.x() * c - p_b.y() * s, a_T_b.y_m + p_b.x() * s + p_b.y() * c};
}

Pose2 inverse(const Pose2& a_T_b) {
  const double c = std::cos(a_T_b.theta_rad);
  const double s = std::sin(a_T_b.theta_rad);
  return {-a_T_b.x_m * c - a_T_b.y_m * s, a_T_b.x_m * s - a_T_b.y_m * c, wrap_angle(-a_T_b.theta_rad)};
}

Pose2 integrate(const Twist2& twist, double tau_s) {
  const double ds = twist.v_m_s * tau_s;
  const double dtheta = twist.omega_rad_s * tau_s;
  // Below this angle the series is exact to double precision, while the quotient loses digits.
  constexpr double kSmallAngle = 1e-6;
  if (std::abs(dtheta) < kSmallAngle) {
    return {ds, ds * dtheta / 2.0, wrap_angle(dtheta)};
  }
  return {ds * std::sin(dtheta) / dtheta, ds * (1.0 - std::cos(dtheta)) / dtheta, wrap_angle(dtheta)};
}

Twist2 twist_between(const Pose2& a_T_from, const Pose2& a_T_to, double tau_s) {
  const Pose2 step = inverse(a_T_from) * a_T_to;
  const double half_rad = 0.5 * wrap_angle(step.theta_rad);
  // Ratio of the length of the arc to that of its chord, which the step is.
  constexpr double kSmallAngle = 1e-6;
  const double arc = std::abs(half_rad) > kSmallAngle ? half_rad / std::sin(half_rad) : 1.0;
  return {std::copysign(step.translation().norm(), step.x_m) * arc / tau_s, 2.0 * half_rad / tau_s};
}

Matrix3 compose_jacobian_a(const Pose2& a, const Pose2& b) {
  const double c = std::cos(a.theta_rad);
  const double s = std::sin(a.theta_rad);
  Matrix3 j = Matrix3::Identity();
  j(0, 2) = -b.x_m * s - b.y_m * c;
  j(1, 2) = b.x_m * c - b.y_m * s;
  return j;
}

Matrix3 compose_jacobian_b(const Pose2& a, const Pose2& /*b*/) {
  const double c = std::cos(a.theta_rad);
  const double s = std::sin(a.theta_rad);
  Matrix3 j;
  j << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0;
  return j;
}

Matrix3 inverse_jacobian(const Pose2& a) {
  const double c = std::cos(a.theta_rad);
  const double s = std::sin(a.theta_rad);
  Matrix3 j;
  j << -c, -s, a.x_m * s - a.y_m * c, s, -c, a.x_m * c + a.y_m * s, 0.0, 0.0, -1.0;
  return j;
}

UncertainPose compose(const UncertainPose& a_T_b, const UncertainPose& b_T_c) {
  const Matrix3 a = compose_jacobian_a(a_T_b.a_T_b, b_T_c.a_T_b);
  const Matrix3 b = compose_jacobian_b(a_T_b.a_T_b, b_T_c.a_T_b);
  return {a_T_b.a_T_b * b_T_c.a_T_b, a * a_T_b.covariance * a.transpose() + b * b_T_c.covariance * b.transpose()};
}

UncertainPose invert(const UncertainPose& a_T_b) {
  const Matrix3 j = inverse_jacobian(a_T_b.a_T_b);
  return {inverse(a_T_b.a_T_b), j * a_T_b.covariance * j.transpose()};
}

double distance_m(const Pose2& a, const Pose2& b) { return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }

Eigen::Vector3d offset_of(const Pose2& pose, const Pose2& from) {
  return {pose.x_m - from.x_m, pose.y_m - from.y_m, wrap_angle(pose.theta_rad - from.theta_rad)};
}

double bearing_to(const Pose2& a_T_b, const Point2& p_a) {
  return wrap_angle(std::atan2(p_a.y() - a_T_b.y_m, p_a.x() - a_T_b.x_m) - a_T_b.theta_rad);
}

bool is_finite(const Pose2& pose) {
  return std::isfinite(pose.x_m) && std::isfinite(pose.y_m) && std::isfinite(pose.theta_rad);
}

std::ostream& operator<<(std::ostream& out, const Pose2& pose) {
  return out << "(" << pose.x_m << " m, " << pose.y_m << " m, " << rad_to_deg(pose.theta_rad) << " deg)";
}

}  // namespace seeker
