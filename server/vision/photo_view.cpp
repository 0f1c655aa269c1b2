#include "server/vision/photo_view.hpp"

#include <cmath>

#include "common/core/assert.hpp"

namespace seeker::vision {
namespace {

/// Rays flatter than this meet the floor nowhere near.
constexpr double kLeastDown = 0.02;

}  // namespace

PhotoView::PhotoView(const ViewParams& params, int width_px, int height_px)
    : focal_px_(0.5 * width_px / std::tan(0.5 * params.photo_fov_rad)),
      centre_u_px_(0.5 * (width_px - 1)),
      centre_v_px_(0.5 * (height_px - 1)),
      cos_tilt_(std::cos(params.photo_tilt_rad)),
      sin_tilt_(std::sin(params.photo_tilt_rad)),
      height_m_(params.photo_height_m) {
  SEEKER_ASSERT(width_px > 0 && height_px > 0);
}

PhotoView::Ray PhotoView::ray(double u_px, double v_px) const {
  const double x = (u_px - centre_u_px_) / focal_px_;
  const double y = (v_px - centre_v_px_) / focal_px_;
  return {cos_tilt_ - y * sin_tilt_, x, sin_tilt_ + y * cos_tilt_};
}

double PhotoView::bearing_rad(double u_px, double v_px) const {
  const Ray r = ray(u_px, v_px);
  return std::atan2(-r.right, r.ahead);
}

std::optional<double> PhotoView::floor_range_m(double u_px, double v_px) const {
  const Ray r = ray(u_px, v_px);
  if (height_m_ <= 0.0 || r.down < kLeastDown) {
    return std::nullopt;
  }
  return height_m_ * std::hypot(r.ahead, r.right) / r.down;
}

std::optional<double> PhotoView::floor_scale_m(double u_px, double v_px) const {
  const Ray r = ray(u_px, v_px);
  if (height_m_ <= 0.0 || r.down < kLeastDown) {
    return std::nullopt;
  }
  return height_m_ / r.down / focal_px_;
}

}  // namespace seeker::vision
