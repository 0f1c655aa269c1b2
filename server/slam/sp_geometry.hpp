/// \file
/// Geometry of the SPmap: frames, perturbations and their Jacobians (spec S0.3, S1.1-S1.10). Rows and columns of a
/// segment are in the order (y, theta, left, right) throughout; a virtual end has no row.
#pragma once

#include <Eigen/Core>

#include "common/core/pose2.hpp"

namespace seeker::slam {

using Vector4 = Eigen::Vector4d;
using Matrix4 = Eigen::Matrix4d;
using Matrix43 = Eigen::Matrix<double, 4, 3>;

/// beta_e of eq (8b): -1 for the left end, +1 for the right one.
[[nodiscard]] constexpr double end_sign(std::size_t side) { return side == 0 ? -1.0 : 1.0; }

/// J{a} of S0.3: a (+) d (+) ((-)a) = J{a} d to first order.
[[nodiscard]] Matrix3 transport(const Pose2& a);

/// The pose of an observation O on the x axis of a segment F, and its derivatives by the robot's pose (S1.5).
struct PairGeometry {
  double x_m = 0.0;  ///< x_FO = (-)X_F (+) X_R (+) x_RO
  double y_m = 0.0;
  double phi_rad = 0.0;
  double cos_phi = 1.0;
  double sin_phi = 0.0;
  Eigen::RowVector3d robot_x;  ///< derivatives R_x and R_y; R_theta is [0 0 1]
  Eigen::RowVector3d robot_y;

  /// x in F of the end of O: t_e = x + q_e cos(phi), with q_e = beta_e L_O / 2.
  [[nodiscard]] double end_x_m(std::size_t side, double observed_length_m) const {
    return x_m + 0.5 * end_sign(side) * observed_length_m * cos_phi;
  }
};
[[nodiscard]] PairGeometry pair_geometry(const Pose2& map_T_segment, const Pose2& map_T_base,
                                         const Pose2& base_T_observation);

/// f of eq (12) with its endpoint rows, and its derivatives with respect to d_R, p_F and p_O.
struct PairRows {
  Vector4 f = Vector4::Zero();
  Matrix43 robot = Matrix43::Zero();
  Matrix4 segment = Matrix4::Zero();
  Matrix4 observation = Matrix4::Zero();
};
[[nodiscard]] PairRows pair_rows(const PairGeometry& pair, double segment_length_m, double observed_length_m);

/// The row of a virtual end that becomes real (S1.7): p_e = robot p_R + segment (p_y, p_theta) + own p_{O,e}.
struct EndRow {
  Eigen::RowVector3d robot;
  Eigen::RowVector2d segment;
  double own = 1.0;
};
[[nodiscard]] EndRow end_row(const PairGeometry& pair, std::size_t side, double observed_length_m);

/// M of S1.8: p_F = M d_R + p_O of a new segment.
[[nodiscard]] Matrix43 new_segment_rows(const Pose2& base_T_observation);

/// Merging of two segments of one wall (S1.9): x_ij, f = (y, phi) and its derivatives with respect to (p_y, p_theta).
struct MergeRows {
  Pose2 i_T_j;
  Eigen::Vector2d f = Eigen::Vector2d::Zero();
  Matrix2 first = Matrix2::Zero();
  Matrix2 second = Matrix2::Zero();
};
[[nodiscard]] MergeRows merge_rows(const Pose2& map_T_i, const Pose2& map_T_j);

/// Eq (8): frame and length of a segment whose perturbation is p.
struct SegmentShape {
  Pose2 map_T_segment;
  double length_m = 0.0;
};
[[nodiscard]] SegmentShape perturbed(const SegmentShape& shape, const Vector4& p);

/// Q_R and Q_F of eq (17), in the complete form of S1.10.
[[nodiscard]] Matrix3 robot_centring(double p_theta);
[[nodiscard]] Matrix4 segment_centring(const Vector4& p);

}  // namespace seeker::slam
