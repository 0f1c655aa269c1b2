#include "server/localize/geometry.hpp"

#include <cmath>

#include <Eigen/Eigenvalues>

namespace seeker::localize {
namespace {

/// Covariance of (u_left, v_left, disparity).
Matrix3 pixel_covariance(const PixelNoise& noise) {
  const double var = noise.sigma_px * noise.sigma_px;
  Matrix3 covariance = Matrix3::Identity() * var;
  if (noise.separate_eyes) {
    covariance(2, 2) = 2.0 * var;
    covariance(0, 2) = covariance(2, 0) = var;
  } else {
    covariance(2, 2) = noise.sigma_disparity_px * noise.sigma_disparity_px;
  }
  return covariance;
}

Matrix3 rotation(double theta_rad) {
  const double c = std::cos(theta_rad);
  const double s = std::sin(theta_rad);
  Matrix3 turn;
  turn << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0;
  return turn;
}

}  // namespace

double largest_sigma(const Matrix2& covariance) {
  return std::sqrt(Eigen::SelfAdjointEigenSolver<Matrix2>(covariance, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff());
}

std::optional<UncertainPoint> triangulate(const StereoGeometry& geometry, const vision::StereoFeature& feature,
                                          const PixelNoise& noise) {
  const double d = feature.disparity_px;
  if (!(d > 0.0)) {
    return std::nullopt;
  }
  const double m_per_px = geometry.baseline_m / d;
  UncertainPoint point;
  point.p = {m_per_px * geometry.focal_px, m_per_px * (geometry.centre_u_px - feature.left.u_px),
             m_per_px * (geometry.centre_v_px - feature.left.v_px)};
  Matrix3 jacobian = Matrix3::Zero();
  jacobian(1, 0) = -m_per_px;
  jacobian(2, 1) = -m_per_px;
  jacobian.col(2) = -point.p / d;
  point.covariance = jacobian * pixel_covariance(noise) * jacobian.transpose();
  return point;
}

Point3 to_map(const Pose2& map_T_eye, double eye_height_m, const Point3& p_eye) {
  const Point2 flat = map_T_eye * Point2(p_eye.head<2>());
  return {flat.x(), flat.y(), eye_height_m + p_eye.z()};
}

Point3 to_eye(const Pose2& map_T_eye, double eye_height_m, const Point3& p_map) {
  const double c = std::cos(map_T_eye.theta_rad);
  const double s = std::sin(map_T_eye.theta_rad);
  const Point2 offset = p_map.head<2>() - map_T_eye.translation();
  return {c * offset.x() + s * offset.y(), c * offset.y() - s * offset.x(), p_map.z() - eye_height_m};
}

Matrix3 to_map_jacobian(const Pose2& map_T_eye, const Point3& p_eye) {
  const double c = std::cos(map_T_eye.theta_rad);
  const double s = std::sin(map_T_eye.theta_rad);
  Matrix3 jacobian = Matrix3::Zero();
  jacobian(0, 0) = jacobian(1, 1) = 1.0;
  jacobian(0, 2) = -s * p_eye.x() - c * p_eye.y();
  jacobian(1, 2) = c * p_eye.x() - s * p_eye.y();
  return jacobian;
}

Matrix3 rotate_covariance(const Pose2& map_T_eye, const Matrix3& covariance_eye) {
  const Matrix3 turn = rotation(map_T_eye.theta_rad);
  return turn * covariance_eye * turn.transpose();
}

std::optional<Pixel> project(const StereoGeometry& geometry, const Point3& p_eye) {
  if (!(p_eye.x() > 0.0)) {
    return std::nullopt;
  }
  const double px_per_m = geometry.focal_px / p_eye.x();
  const Pixel pixel{geometry.centre_u_px - px_per_m * p_eye.y(), geometry.centre_v_px - px_per_m * p_eye.z(),
                    px_per_m * geometry.baseline_m};
  const bool inside =
      pixel.u_px >= 0.0 && pixel.u_px < geometry.width_px && pixel.v_px >= 0.0 && pixel.v_px < geometry.height_px;
  return inside ? std::optional(pixel) : std::nullopt;
}

std::optional<UncertainPoint> triangulate_within(const StereoGeometry& geometry, const vision::StereoFeature& feature,
                                                 const PixelNoise& noise, const RangeLimits& limits) {
  const auto eye = triangulate(geometry, feature, noise);
  const double range_m = eye ? eye->p.head<2>().norm() : 0.0;
  return eye && range_m >= limits.min_m && range_m <= limits.max_m ? eye : std::nullopt;
}

double scale_of(const StereoGeometry& geometry, const vision::StereoFeature& feature, const UncertainPoint& p_eye) {
  return feature.left.scale_px * p_eye.p.x() / geometry.focal_px;
}

std::vector<SeenPoint> see(const StereoGeometry& geometry, const Sighting& sighting, const PixelNoise& noise,
                           const RangeLimits& limits) {
  std::vector<SeenPoint> points;
  points.reserve(sighting.features.size());
  for (std::size_t i = 0; i < sighting.features.size(); ++i) {
    const vision::StereoFeature& feature = sighting.features[i];
    const auto eye = triangulate_within(geometry, feature, noise, limits);
    if (!eye) {
      continue;
    }
    const Matrix3 by_pose = to_map_jacobian(sighting.map_T_eye, eye->p);
    SeenPoint point;
    point.feature = i;
    point.map.p = to_map(sighting.map_T_eye, sighting.eye_height_m, eye->p);
    point.map.covariance = rotate_covariance(sighting.map_T_eye, eye->covariance) +
                           by_pose * sighting.pose_covariance * by_pose.transpose();
    const Point3 eye_map(sighting.map_T_eye.x_m, sighting.map_T_eye.y_m, sighting.eye_height_m);
    point.to_eye = (eye_map - point.map.p).normalized();
    point.scale_m = scale_of(geometry, feature, *eye);
    point.range_m = eye->p.head<2>().norm();
    points.push_back(point);
  }
  return points;
}

}  // namespace seeker::localize
