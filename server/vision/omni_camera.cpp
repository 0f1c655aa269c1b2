#include "server/vision/omni_camera.hpp"

#include <cmath>
#include <string>

#include "common/core/angle.hpp"
#include "common/core/assert.hpp"

namespace seeker::vision {
namespace {

constexpr double kPolynomialUnit_px = 100.0;
constexpr double kMinAffineDeterminant = 0.1;

double elevation_at(const OmniCameraParams& p, double radius_px) {
  const double x = (radius_px - p.reference_radius_px) / kPolynomialUnit_px;
  double sum = 0.0;
  for (std::size_t k = p.elevation_coefficients.size(); k-- > 0;) {
    sum = sum * x + p.elevation_coefficients[k];
  }
  return sum;
}

/// Pixel to the plane without affine distortion, relative to the mirror's axis.
PixelPoint undistorted(const OmniCameraParams& p, const PixelPoint& pixel) {
  const double dv = pixel.v_px - p.v0_px;
  const double du = pixel.u_px - p.u0_px;
  const double determinant = p.affine_c - p.affine_d * p.affine_e;
  return {(p.affine_c * du - p.affine_e * dv) / determinant, (dv - p.affine_d * du) / determinant};
}

Status validate_profile(const OmniCameraParams& p) {
  double previous_rad = -kPi / 2.0;
  for (double radius_px = p.inner_radius_px; radius_px <= p.outer_radius_px; radius_px += 1.0) {
    const double elevation_rad = elevation_at(p, radius_px);
    if (!(elevation_rad > previous_rad && elevation_rad < kPi / 2.0)) {
      return fail(Errc::kInvalidArgument,
                  "elevation_coefficients: the elevation must rise with the radius and stay within +-90 deg between "
                  "inner_radius_px and outer_radius_px; it does not at radius " +
                      std::to_string(radius_px));
    }
    previous_rad = elevation_rad;
  }
  return {};
}

}  // namespace

Status validate(const OmniCameraParams& p) {
  if (p.width_px < 1 || p.height_px < 1 || p.width_px > kMaxImageSide_px || p.height_px > kMaxImageSide_px) {
    return fail(Errc::kInvalidArgument, "width_px and height_px must lie in 1..8192");
  }
  if (!(p.u0_px >= 0.0 && p.u0_px < p.width_px && p.v0_px >= 0.0 && p.v0_px < p.height_px)) {
    return fail(Errc::kInvalidArgument, "u0_px, v0_px must lie in the picture");
  }
  if (!(p.inner_radius_px >= 0.0 && p.outer_radius_px >= p.inner_radius_px + 2.0 &&
        p.outer_radius_px <= kMaxImageSide_px)) {
    return fail(Errc::kInvalidArgument, "inner_radius_px and outer_radius_px must leave a ring of at least 2 px");
  }
  if (!(std::abs(p.affine_c - p.affine_d * p.affine_e) >= kMinAffineDeterminant)) {
    return fail(Errc::kInvalidArgument, "affine_c, affine_d, affine_e: the matrix cannot be inverted");
  }
  if (!std::isfinite(p.alignment_rad) || !(p.alignment_sigma_rad >= 0.0) || !(p.camera_height_m > 0.0) ||
      !std::isfinite(p.camera_height_m)) {
    return fail(Errc::kInvalidArgument,
                "alignment_rad, alignment_sigma_rad, camera_height_m must be finite, the "
                "sigma not negative, the height positive");
  }
  return validate_profile(p);
}

Status check_size(const OmniCameraParams& params, const Image& picture) {
  if (picture.width_px() != params.width_px || picture.height_px() != params.height_px) {
    return fail(Errc::kInvalidArgument, "the picture is " + std::to_string(picture.width_px()) + "x" +
                                            std::to_string(picture.height_px()) + ", the camera is calibrated for " +
                                            std::to_string(params.width_px) + "x" + std::to_string(params.height_px) +
                                            ": set the camera's resolution or calibrate it again");
  }
  return {};
}

OmniCamera::OmniCamera(const OmniCameraParams& params) : params_(params) {
  SEEKER_ASSERT(validate(params).has_value());
}

double OmniCamera::bearing_base_rad(const PixelPoint& pixel) const {
  const PixelPoint ideal = undistorted(params_, pixel);
  return wrap_angle(std::atan2(-ideal.u_px, -ideal.v_px) + params_.alignment_rad);
}

double OmniCamera::radius_px(const PixelPoint& pixel) const {
  const PixelPoint ideal = undistorted(params_, pixel);
  return std::hypot(ideal.u_px, ideal.v_px);
}

bool OmniCamera::in_ring(const PixelPoint& pixel) const {
  const double radius = radius_px(pixel);
  return radius >= params_.inner_radius_px && radius <= params_.outer_radius_px && pixel.u_px >= 0.0 &&
         pixel.v_px >= 0.0 && pixel.u_px <= params_.width_px - 1 && pixel.v_px <= params_.height_px - 1;
}

double OmniCamera::elevation_rad(double radius_px) const { return elevation_at(params_, radius_px); }

std::optional<double> OmniCamera::radius_of_elevation_px(double elevation_rad) const {
  double low_px = params_.inner_radius_px;
  double high_px = params_.outer_radius_px;
  if (elevation_rad < elevation_at(params_, low_px) || elevation_rad > elevation_at(params_, high_px)) {
    return std::nullopt;
  }
  constexpr double kPrecision_px = 1e-6;
  while (high_px - low_px > kPrecision_px) {
    const double middle_px = 0.5 * (low_px + high_px);
    (elevation_at(params_, middle_px) < elevation_rad ? low_px : high_px) = middle_px;
  }
  return 0.5 * (low_px + high_px);
}

std::optional<PixelPoint> OmniCamera::pixel_of(double bearing_base_rad, double elevation_rad) const {
  const std::optional<double> radius = radius_of_elevation_px(elevation_rad);
  if (!radius) {
    return std::nullopt;
  }
  const double bearing = bearing_base_rad - params_.alignment_rad;
  const double u_ideal = -*radius * std::sin(bearing);
  const double v_ideal = -*radius * std::cos(bearing);
  return PixelPoint{params_.u0_px + params_.affine_e * v_ideal + u_ideal,
                    params_.v0_px + params_.affine_c * v_ideal + params_.affine_d * u_ideal};
}

std::optional<PixelSize> OmniCamera::expected_size_px(double width_m, double height_m, double range_m,
                                                      std::optional<double> centre_height_m) const {
  if (!(range_m > 0.0)) {
    return std::nullopt;
  }
  const double rise_m = centre_height_m.value_or(params_.camera_height_m) - params_.camera_height_m;
  const auto low = radius_of_elevation_px(std::atan2(rise_m - height_m / 2.0, range_m));
  const auto high = radius_of_elevation_px(std::atan2(rise_m + height_m / 2.0, range_m));
  if (!low || !high) {
    return std::nullopt;
  }
  const double half_angle_rad = std::atan2(width_m / 2.0, range_m);
  return PixelSize{(*low + *high) * half_angle_rad, *high - *low};
}

}  // namespace seeker::vision
