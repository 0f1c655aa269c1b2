/// \file
/// Triangulation of stereo features with their uncertainty (spec S2.2, S2.3).
///
/// Points in the frame `eye` are written (forward, left, up): the camera's z, x, y of spec S2.2 in the order of a
/// planar pose, so that `map_T_eye` is a Pose2 whose heading is that of the camera's z axis. Points in the frame `map`
/// are (x, y, height): the u, v, w of spec S2.3.
#pragma once

#include <optional>
#include <vector>

#include "common/core/pose2.hpp"
#include "common/core/stereo.hpp"
#include "common/core/time.hpp"
#include "server/vision/descriptor.hpp"

namespace seeker::localize {

using Point3 = Eigen::Vector3d;

/// Errors of the features' positions in the pictures.
struct PixelNoise {
  double sigma_px = 0.5;  ///< standard deviation of the position in the left picture, in each direction
  /// Standard deviation of the disparity, independent of the left position: it is measured by correlation around it.
  double sigma_disparity_px = 0.3;
  /// Spec S2.9: positions in both pictures have the error sigma_px, and the disparity is their difference.
  bool separate_eyes = false;

  friend bool operator==(const PixelNoise&, const PixelNoise&) = default;
};

/// r_min of the paper's robot: its constraint (2), disparities below 20 px, lets no point nearer than 5.04 m be
/// measured (spec S2.1), so that a landmark nearer than this is not expected to be visible (S2.10).
inline constexpr double kPaperMinRange_m = 5.0;

/// A point with the covariance of its position.
struct UncertainPoint {
  Point3 p = Point3::Zero();
  Matrix3 covariance = Matrix3::Zero();
};

/// The standard deviation in the direction in which it is largest.
[[nodiscard]] double largest_sigma(const Matrix2& covariance);

/// Triangulates by eqs (2)-(4) with offsets from the principal point, with the covariance by the noise of the pixels,
/// to first order. No value where the disparity is not positive.
[[nodiscard]] std::optional<UncertainPoint> triangulate(const StereoGeometry& geometry,
                                                        const vision::StereoFeature& feature, const PixelNoise& noise);

/// Transforms points between the frames `eye` and `map`, eqs (5)-(7).
[[nodiscard]] Point3 to_map(const Pose2& map_T_eye, double eye_height_m, const Point3& p_eye);
[[nodiscard]] Point3 to_eye(const Pose2& map_T_eye, double eye_height_m, const Point3& p_map);
/// The derivative d(to_map)/d(x, y, theta).
[[nodiscard]] Matrix3 to_map_jacobian(const Pose2& map_T_eye, const Point3& p_eye);
/// Rotates a covariance of the frame `eye` into the frame `map`.
[[nodiscard]] Matrix3 rotate_covariance(const Pose2& map_T_eye, const Matrix3& covariance_eye);

/// Projection of a point of the frame `eye` into the left picture.
struct Pixel {
  double u_px = 0.0;
  double v_px = 0.0;
  double disparity_px = 0.0;
};
/// Projects a point; no value behind the eye or outside the picture.
[[nodiscard]] std::optional<Pixel> project(const StereoGeometry& geometry, const Point3& p_eye);

/// The features of one stereo frame with the pose of the eye.
struct Sighting {
  RobotTime stamp;
  Pose2 map_T_eye;
  Matrix3 pose_covariance = Matrix3::Zero();  ///< covariance of (x, y, theta), in the frame map
  double eye_height_m = 0.0;
  std::vector<vision::StereoFeature> features;
};

/// A feature of a sighting in the frame `map`.
struct SeenPoint {
  std::size_t feature = 0;         ///< its index in the sighting
  UncertainPoint map;              ///< position including the uncertainty of the eye's pose
  Point3 to_eye = Point3::Zero();  ///< unit vector from the point to the eye, in the frame map
  double scale_m = 0.0;            ///< size of the feature: sigma of its blur at its distance
  double range_m = 0.0;            ///< horizontal distance
};

/// Limits of the horizontal distance of features, spec S2.10.
struct RangeLimits {
  double min_m = 0.6;
  double max_m = 8.0;

  friend bool operator==(const RangeLimits&, const RangeLimits&) = default;
};

/// As triangulate(); no value outside the limits.
[[nodiscard]] std::optional<UncertainPoint> triangulate_within(const StereoGeometry& geometry,
                                                               const vision::StereoFeature& feature,
                                                               const PixelNoise& noise, const RangeLimits& limits);

/// The sigma of a feature's blur at its distance, in m.
[[nodiscard]] double scale_of(const StereoGeometry& geometry, const vision::StereoFeature& feature,
                              const UncertainPoint& p_eye);

/// The features of a sighting in the frame `map`; features outside the limits are left out.
[[nodiscard]] std::vector<SeenPoint> see(const StereoGeometry& geometry, const Sighting& sighting,
                                         const PixelNoise& noise, const RangeLimits& limits);

}  // namespace seeker::localize
