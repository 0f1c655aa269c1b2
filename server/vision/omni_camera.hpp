/// \file
/// Omnidirectional (catadioptric) camera looking up into a mirror: pixels to bearings and back (spec S3.5, eq (4)).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "common/core/result.hpp"
#include "server/vision/sighting.hpp"

namespace seeker::vision {

/// Calibration of one omnidirectional camera. The picture's up is forward, its left is +90 deg, and outward is up.
struct OmniCameraParams {
  int width_px = 640;
  int height_px = 480;
  double u0_px = 315.0;  ///< image of the mirror's axis, spec S3.5 [P]
  double v0_px = 240.0;
  double inner_radius_px = 63.0;   ///< within this radius the robot sees itself
  double outer_radius_px = 232.0;  ///< rim of the mirror
  /// OCamCalib's affine part, rows first: [v - v0; u - u0] = [c d; e 1] [v_ideal; u_ideal].
  double affine_c = 1.0;
  double affine_d = 0.0;
  double affine_e = 0.0;
  double alignment_rad = 0.0;          ///< known rotation of the camera about the vertical, added to every bearing
  double alignment_sigma_rad = 0.026;  ///< standard deviation of the remaining rotation: 1 to 2 deg, spec S3.5 [P]
  double camera_height_m = 0.60;       ///< height of the mirror's focus above the floor
  /// The elevation law elevation_rad(radius) = sum over k of coefficient[k] * ((radius - reference_radius_px) / 100
  /// px)^k, which must rise with the radius between the inner and the outer one. The default was fitted to a hyperbolic
  /// mirror whose horizon is at 172.7 px; largest error 0.0012 rad.
  double reference_radius_px = 172.7;
  std::array<double, 4> elevation_coefficients = {0.0, 0.6391, -0.1458, 0.0163};

  friend bool operator==(const OmniCameraParams&, const OmniCameraParams&) = default;
};

/// Fails with kInvalidArgument and the field's name for sizes, radii, an affine part or a polynomial that describe no
/// camera.
[[nodiscard]] Status validate(const OmniCameraParams& params);

/// A position in the picture; sub-pixel, (0, 0) is the centre of the first pixel.
struct PixelPoint {
  double u_px = 0.0;
  double v_px = 0.0;
};

/// The camera's geometry. Bearings do not depend on the mirror's profile, only on centre and affine part.
class OmniCamera {
 public:
  /// Requires parameters that pass validate() (asserted).
  explicit OmniCamera(const OmniCameraParams& params = {});

  [[nodiscard]] const OmniCameraParams& params() const { return params_; }
  /// The bearing alpha' = atan2(u0 - u, v0 - v) after undoing the affine part, plus the alignment; (-pi, pi]. Spec
  /// S3.5, eq (4).
  [[nodiscard]] double bearing_base_rad(const PixelPoint& pixel) const;
  /// Distance from the mirror's axis after undoing the affine part.
  [[nodiscard]] double radius_px(const PixelPoint& pixel) const;
  /// Whether the mirror shows the surroundings at this pixel.
  [[nodiscard]] bool in_ring(const PixelPoint& pixel) const;
  /// Elevation above the horizon of the rays at a radius between the inner and the outer one.
  [[nodiscard]] double elevation_rad(double radius_px) const;
  /// Inverse of elevation_rad; no value where the mirror does not show that elevation.
  [[nodiscard]] std::optional<double> radius_of_elevation_px(double elevation_rad) const;
  /// The pixel of a direction; no value where the mirror does not show it.
  [[nodiscard]] std::optional<PixelPoint> pixel_of(double bearing_base_rad, double elevation_rad) const;
  /// Size of an upright target of width_m x height_m that faces the camera at range_m (> 0) on the floor plane, its
  /// centre at centre_height_m above the floor (default: the camera's height). No value where the mirror does not show
  /// the whole target.
  [[nodiscard]] std::optional<PixelSize> expected_size_px(double width_m, double height_m, double range_m,
                                                          std::optional<double> centre_height_m = {}) const;

 private:
  OmniCameraParams params_;
};

/// Refuses a picture whose size is not the calibrated one.
[[nodiscard]] Status check_size(const OmniCameraParams& params, const Image& picture);

}  // namespace seeker::vision
