/// \file
/// Planar frames (spec S0.3): `a_T_b` maps points expressed in b to points expressed in a; products must cancel,
/// `map_T_laser = map_T_base * base_T_laser`. Right-handed, x forward, y left, theta counter-clockwise.
#pragma once

#include <iosfwd>

#include <Eigen/Core>

namespace seeker {

using Point2 = Eigen::Vector2d;
using Matrix2 = Eigen::Matrix2d;
using Matrix3 = Eigen::Matrix3d;

/// A planar rigid transform, or the pose of frame b in frame a.
struct Pose2 {
  double x_m = 0.0;
  double y_m = 0.0;
  double theta_rad = 0.0;

  [[nodiscard]] Point2 translation() const { return {x_m, y_m}; }
  friend bool operator==(const Pose2&, const Pose2&) = default;
};

/// Velocity of the base in its own frame.
struct Twist2 {
  double v_m_s = 0.0;
  double omega_rad_s = 0.0;

  friend bool operator==(const Twist2&, const Twist2&) = default;
};

/// Composition of two transforms, a (+) b of spec S0.3. The angle of the result is wrapped.
[[nodiscard]] Pose2 operator*(const Pose2& a_T_b, const Pose2& b_T_c);
/// Transforms a point from b to a.
[[nodiscard]] Point2 operator*(const Pose2& a_T_b, const Point2& p_b);
/// Inverse of a transform, (-) a of spec S0.3.
[[nodiscard]] Pose2 inverse(const Pose2& a_T_b);
/// Motion of the base over `tau_s` seconds of constant twist (spec S1.3): exact on the arc.
[[nodiscard]] Pose2 integrate(const Twist2& twist, double tau_s);
/// The constant twist that leads from one pose to the other in `tau_s` > 0 seconds, along an arc: the inverse of
/// integrate() for rotations below pi.
[[nodiscard]] Twist2 twist_between(const Pose2& a_T_from, const Pose2& a_T_to, double tau_s);

/// d(a (+) b)/da and d(a (+) b)/db (spec S0.3: J1, J2).
[[nodiscard]] Matrix3 compose_jacobian_a(const Pose2& a, const Pose2& b);
[[nodiscard]] Matrix3 compose_jacobian_b(const Pose2& a, const Pose2& b);
/// d((-) a)/da (spec S0.3).
[[nodiscard]] Matrix3 inverse_jacobian(const Pose2& a);

/// A pose with the covariance of its (x, y, theta), expressed in the frame that the pose is given in.
struct UncertainPose {
  Pose2 a_T_b;
  Matrix3 covariance = Matrix3::Zero();

  friend bool operator==(const UncertainPose&, const UncertainPose&) = default;
};

/// a_T_b (+) b_T_c with independent errors (spec S0.3, first order).
[[nodiscard]] UncertainPose compose(const UncertainPose& a_T_b, const UncertainPose& b_T_c);
[[nodiscard]] UncertainPose invert(const UncertainPose& a_T_b);

[[nodiscard]] double distance_m(const Pose2& a, const Pose2& b);
/// Difference of two poses of one frame, `pose` minus `from`: (x, y, theta) in that frame, theta wrapped to (-pi, pi].
[[nodiscard]] Eigen::Vector3d offset_of(const Pose2& pose, const Pose2& from);
/// Bearing of point p_a (in the frame the pose is given in) seen from the pose, wrapped.
[[nodiscard]] double bearing_to(const Pose2& a_T_b, const Point2& p_a);
[[nodiscard]] bool is_finite(const Pose2& pose);

std::ostream& operator<<(std::ostream& out, const Pose2& pose);

}  // namespace seeker
