#include "server/slam/sp_geometry.hpp"

#include <cmath>

#include "common/core/angle.hpp"

namespace seeker::slam {

Matrix3 transport(const Pose2& a) {
  const double c = std::cos(a.theta_rad);
  const double s = std::sin(a.theta_rad);
  Matrix3 j;
  j << c, -s, a.y_m, s, c, -a.x_m, 0.0, 0.0, 1.0;
  return j;
}

PairGeometry pair_geometry(const Pose2& map_T_segment, const Pose2& map_T_base, const Pose2& base_T_observation) {
  const Pose2& o = base_T_observation;
  const Pose2 x_fo = inverse(map_T_segment) * (map_T_base * o);
  PairGeometry pair;
  pair.x_m = x_fo.x_m;
  pair.y_m = x_fo.y_m;
  pair.phi_rad = x_fo.theta_rad;
  pair.cos_phi = std::cos(x_fo.theta_rad);
  pair.sin_phi = std::sin(x_fo.theta_rad);
  const double c_psi = std::cos(o.theta_rad);
  const double s_psi = std::sin(o.theta_rad);
  const double x_prime = -o.x_m * c_psi - o.y_m * s_psi;
  const double y_prime = o.x_m * s_psi - o.y_m * c_psi;
  const double c = pair.cos_phi * c_psi + pair.sin_phi * s_psi;  // of phi - psi
  const double s = pair.sin_phi * c_psi - pair.cos_phi * s_psi;
  pair.robot_x << c, -s, y_prime * pair.cos_phi + x_prime * pair.sin_phi;
  pair.robot_y << s, c, y_prime * pair.sin_phi - x_prime * pair.cos_phi;
  return pair;
}

PairRows pair_rows(const PairGeometry& pair, double segment_length_m, double observed_length_m) {
  PairRows rows;
  rows.f(0) = pair.y_m;
  rows.f(1) = pair.phi_rad;
  rows.robot.row(0) = pair.robot_y;
  rows.robot(1, 2) = 1.0;
  rows.segment.row(0) << -1.0, -pair.x_m, 0.0, 0.0;
  rows.segment(1, 1) = -1.0;
  rows.observation(0, 0) = pair.cos_phi;
  rows.observation(1, 1) = 1.0;
  for (std::size_t side = 0; side < 2; ++side) {
    const auto k = static_cast<Eigen::Index>(2 + side);
    const double q = 0.5 * end_sign(side) * observed_length_m;
    rows.f(k) = pair.x_m + q * pair.cos_phi - 0.5 * end_sign(side) * segment_length_m;
    rows.robot.row(k) = pair.robot_x;
    rows.robot(k, 2) -= q * pair.sin_phi;
    rows.segment(k, 1) = pair.y_m + q * pair.sin_phi;
    rows.segment(k, k) = -1.0;
    rows.observation(k, 0) = -pair.sin_phi;
    rows.observation(k, 1) = -q * pair.sin_phi;
    rows.observation(k, k) = pair.cos_phi;
  }
  return rows;
}

EndRow end_row(const PairGeometry& pair, std::size_t side, double observed_length_m) {
  const double q = 0.5 * end_sign(side) * observed_length_m;
  EndRow row;
  row.robot = pair.robot_x;
  row.robot(2) -= q * pair.sin_phi;
  row.segment << 0.0, pair.y_m + q * pair.sin_phi;
  row.own = pair.cos_phi;
  return row;
}

Matrix43 new_segment_rows(const Pose2& base_T_observation) {
  const Matrix3 j = transport(inverse(base_T_observation));
  Matrix43 rows;
  rows << j.row(1), j.row(2), j.row(0), j.row(0);
  return rows;
}

MergeRows merge_rows(const Pose2& map_T_i, const Pose2& map_T_j) {
  MergeRows rows;
  rows.i_T_j = inverse(map_T_i) * map_T_j;
  rows.f << rows.i_T_j.y_m, rows.i_T_j.theta_rad;
  rows.first << -1.0, -rows.i_T_j.x_m, 0.0, -1.0;
  rows.second << std::cos(rows.i_T_j.theta_rad), 0.0, 0.0, 1.0;
  return rows;
}

SegmentShape perturbed(const SegmentShape& shape, const Vector4& p) {
  SegmentShape moved;
  moved.map_T_segment = shape.map_T_segment * Pose2{0.0, p(0), p(1)} * Pose2{0.5 * (p(2) + p(3)), 0.0, 0.0};
  moved.length_m = shape.length_m - p(2) + p(3);
  return moved;
}

Matrix3 robot_centring(double p_theta) {
  const double c = std::cos(p_theta);
  const double s = std::sin(p_theta);
  Matrix3 q;
  q << c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0;
  return q;
}

Matrix4 segment_centring(const Vector4& p) {
  const double s = 0.5 * (p(2) + p(3));
  Matrix4 q = Matrix4::Identity();
  q(0, 0) = std::cos(p(1));
  q(0, 1) = s;
  q(2, 0) = std::sin(p(1));
  q(3, 0) = q(2, 0);
  return q;
}

}  // namespace seeker::slam
