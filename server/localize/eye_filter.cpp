#include "server/localize/eye_filter.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "common/core/angle.hpp"
#include "common/core/assert.hpp"

namespace seeker::localize {
namespace {

using Vector4 = Eigen::Vector4d;
using Matrix4 = Eigen::Matrix4d;

/// A landmark nearer than this to the eye has no bearing.
constexpr double kLeastRange_m = 1e-3;

void symmetrise(Matrix4& covariance) { covariance = 0.5 * (covariance + covariance.transpose()).eval(); }

Vector4 state_of(const EyeBelief& belief) {
  return {belief.map_T_eye.x_m, belief.map_T_eye.y_m, belief.map_T_eye.theta_rad, belief.disparity_offset_px};
}

void set_state(EyeBelief& belief, const Vector4& state) {
  belief.map_T_eye = {state(0), state(1), wrap_angle(state(2))};
  belief.disparity_offset_px = state(3);
}

/// Motion of the eye in the frame map by the given velocity of the robot, and its derivative by the three velocities.
struct EyeMotion {
  Pose2 map_T_eye;
  Eigen::Matrix<double, 3, 3> by_velocity;  ///< d(x, y, theta)/d(v, across, omega)
};

EyeMotion move_eye(const Pose2& map_T_eye, const Twist2& velocity, double tau_s, const LeverArm& arm, bool exact) {
  const double heading = map_T_eye.theta_rad - arm.yaw_rad;  // of the robot
  const double c = std::cos(heading);
  const double s = std::sin(heading);
  const double sideways = arm.ahead_m * s + arm.left_m * c;  // b sin + a cos, eq (11)
  const double forwards = arm.ahead_m * c - arm.left_m * s;
  EyeMotion motion;
  motion.by_velocity << c, -s, -sideways, s, c, forwards, 0.0, 0.0, 1.0;
  motion.by_velocity *= tau_s;
  if (exact) {
    const Pose2 map_T_base = map_T_eye * inverse(arm.base_T_eye());
    motion.map_T_eye = map_T_base * integrate(velocity, tau_s) * arm.base_T_eye();
  } else {
    const Eigen::Vector3d step = motion.by_velocity * Eigen::Vector3d(velocity.v_m_s, 0.0, velocity.omega_rad_s);
    motion.map_T_eye = {map_T_eye.x_m + step(0), map_T_eye.y_m + step(1), wrap_angle(map_T_eye.theta_rad + step(2))};
  }
  return motion;
}

double square(double x) { return x * x; }

}  // namespace

void predict(EyeBelief& belief, const Twist2& velocity, double tau_s, const LeverArm& arm, const MotionNoise& noise,
             bool exact) {
  SEEKER_ASSERT(tau_s >= 0.0);
  const EyeMotion motion = move_eye(belief.map_T_eye, velocity, tau_s, arm, exact);
  // Both forms of eq (11) rotate their step with the heading, so that F follows from the step itself.
  Matrix4 transition = Matrix4::Identity();
  transition(0, 2) = -(motion.map_T_eye.y_m - belief.map_T_eye.y_m);
  transition(1, 2) = motion.map_T_eye.x_m - belief.map_T_eye.x_m;
  const double v = std::abs(velocity.v_m_s);
  const double omega = std::abs(velocity.omega_rad_s);
  const Eigen::Vector3d variances(square(noise.v_share * v + noise.v_floor_m_s), square(noise.across_share * v),
                                  square(noise.omega_share * omega + noise.omega_floor_rad_s + noise.drift_per_m * v));
  belief.covariance = (transition * belief.covariance * transition.transpose()).eval();
  belief.covariance.topLeftCorner<3, 3>() +=
      motion.by_velocity * variances.asDiagonal() * motion.by_velocity.transpose() +
      noise.variance_floor * Matrix3::Identity();
  symmetrise(belief.covariance);
  belief.map_T_eye = motion.map_T_eye;
}

Pose2 base_from_eye(const Pose2& map_T_eye, const LeverArm& arm) { return map_T_eye * inverse(arm.base_T_eye()); }
Pose2 eye_from_base(const Pose2& map_T_base, const LeverArm& arm) { return map_T_base * arm.base_T_eye(); }

Matrix3 base_covariance(const Pose2& map_T_eye, const Matrix3& eye_covariance, const LeverArm& arm) {
  const Matrix3 jacobian = compose_jacobian_a(map_T_eye, inverse(arm.base_T_eye()));
  return jacobian * eye_covariance * jacobian.transpose();
}

Matrix3 eye_covariance(const Pose2& map_T_base, const Matrix3& base_covariance, const LeverArm& arm) {
  const Matrix3 jacobian = compose_jacobian_a(map_T_base, arm.base_T_eye());
  return jacobian * base_covariance * jacobian.transpose();
}

RangeBearing measure(const UncertainPoint& p_eye, double disparity_px, const MeasurementNoise& noise) {
  const double ahead = p_eye.p.x();
  const double left = p_eye.p.y();
  const double range = std::max(std::hypot(ahead, left), kLeastRange_m);
  RangeBearing seen;
  seen.range_m = range;
  seen.beta_rad = kPi / 2.0 + std::atan2(left, ahead);
  Matrix2 jacobian;
  jacobian << ahead / range, left / range, -left / square(range), ahead / square(range);
  seen.covariance = jacobian * p_eye.covariance.topLeftCorner<2, 2>() * jacobian.transpose();
  seen.covariance(0, 0) += square(noise.range_floor_m);
  seen.covariance(1, 1) += square(noise.bearing_floor_rad);
  // A disparity that errs scales the whole point: the bearing stays.
  seen.range_per_disparity_m = -range / disparity_px;
  return seen;
}

std::optional<Innovation> innovate(const EyeBelief& belief, const RangeBearing& seen) {
  const Point2 offset = seen.landmark - belief.map_T_eye.translation();
  const double range = offset.norm();
  if (!(range > kLeastRange_m)) {
    return std::nullopt;
  }
  Innovation result;
  const double beta = std::atan2(offset.y(), offset.x()) - belief.map_T_eye.theta_rad + kPi / 2.0;
  result.residual = {seen.range_m - range - seen.range_per_disparity_m * belief.disparity_offset_px,
                     wrap_angle(seen.beta_rad - beta)};
  Matrix2 by_place;  // of the landmark; the eye's is its negative
  by_place << offset.x() / range, offset.y() / range, -offset.y() / square(range), offset.x() / square(range);
  result.jacobian.setZero();
  result.jacobian.leftCols<2>() = -by_place;
  result.jacobian(1, 2) = -1.0;
  result.jacobian(0, 3) = seen.range_per_disparity_m;
  result.noise = seen.covariance + by_place * seen.landmark_covariance * by_place.transpose();
  result.covariance = result.noise + result.jacobian * belief.covariance * result.jacobian.transpose();
  result.chi2 = result.residual.dot(result.covariance.ldlt().solve(result.residual));
  return result;
}

double update_sequentially(EyeBelief& belief, std::span<const RangeBearing> seen) {
  double nis = 0.0;
  for (const RangeBearing& one : seen) {
    const auto innovation = innovate(belief, one);
    if (!innovation) {
      continue;
    }
    const Eigen::Matrix<double, 4, 2> gain =
        belief.covariance * innovation->jacobian.transpose() * innovation->covariance.inverse();
    set_state(belief, state_of(belief) + gain * innovation->residual);
    belief.covariance = ((Matrix4::Identity() - gain * innovation->jacobian) * belief.covariance).eval();
    symmetrise(belief.covariance);
    nis += innovation->chi2;
  }
  return nis;
}

namespace {

/// Sums of one linearisation: what all measurements together say about the state.
struct Normal {
  Matrix4 information = Matrix4::Zero();  ///< H' R^-1 H
  Vector4 pull = Vector4::Zero();         ///< H' R^-1 residual
};

/// Measurements whose residual is far beyond their noise count as noisier ones (Huber).
Normal sum_up(const EyeBelief& at, std::span<const RangeBearing> seen, double huber_sigmas) {
  Normal sum;
  for (const RangeBearing& one : seen) {
    const auto innovation = innovate(at, one);
    if (!innovation) {
      continue;
    }
    const double sigmas = std::sqrt(innovation->residual.dot(innovation->noise.ldlt().solve(innovation->residual)));
    const double weight = sigmas > huber_sigmas ? huber_sigmas / sigmas : 1.0;
    const Eigen::Matrix<double, 4, 2> weighted =
        weight * innovation->jacobian.transpose() * innovation->noise.inverse();
    sum.information += weighted * innovation->jacobian;
    sum.pull += weighted * innovation->residual;
  }
  return sum;
}

}  // namespace

double update_together(EyeBelief& belief, std::span<const RangeBearing> seen, const BatchParams& params) {
  double nis = 0.0;
  for (const RangeBearing& one : seen) {
    const auto innovation = innovate(belief, one);
    nis += innovation ? innovation->chi2 : 0.0;
  }
  const EyeBelief before = belief;
  const Matrix4 prior = before.covariance;
  Matrix4 after = prior;
  Normal sum;
  for (int i = 0; i < params.iterations; ++i) {
    sum = sum_up(belief, seen, params.huber_sigmas);
    // P' = (P^-1 + A)^-1 without inverting P, which may have no variance in the offset at all.
    after = (Matrix4::Identity() + prior * sum.information).partialPivLu().solve(prior);
    Vector4 from_before = state_of(belief) - state_of(before);
    from_before(2) = wrap_angle(from_before(2));
    const Vector4 step = after * (sum.pull + sum.information * from_before);
    set_state(belief, state_of(before) + step);
  }
  // Joseph's form: K H = P' A and K R K' = P' A P', as R is block diagonal.
  const Matrix4 keep = Matrix4::Identity() - after * sum.information;
  belief.covariance = keep * prior * keep.transpose() + after * sum.information * after.transpose();
  symmetrise(belief.covariance);
  return nis;
}

}  // namespace seeker::localize
