/// \file
/// Directions of the pixels of a plain photograph: a camera without roll, level or tilted down at the floor.
#pragma once

#include <optional>

#include "server/vision/recogniser_params.hpp"

namespace seeker::vision {

class PhotoView {
 public:
  /// Of pictures of this size. Asserts that it is not empty.
  PhotoView(const ViewParams& params, int width_px, int height_px);

  [[nodiscard]] double focal_px() const { return focal_px_; }
  /// In the plane of the floor, left positive, 0 straight ahead.
  [[nodiscard]] double bearing_rad(double u_px, double v_px) const;
  /// From below the camera to where the pixel shows the floor. Nothing at or above the horizon, nor where the camera's
  /// height is not known.
  [[nodiscard]] std::optional<double> floor_range_m(double u_px, double v_px) const;
  /// Length on a plane across the optical axis, at the distance of that place on the floor, that one pixel spans.
  [[nodiscard]] std::optional<double> floor_scale_m(double u_px, double v_px) const;

 private:
  struct Ray {
    double ahead = 1.0;  ///< along the floor
    double right = 0.0;
    double down = 0.0;  ///< all three for 1 along the optical axis
  };
  [[nodiscard]] Ray ray(double u_px, double v_px) const;

  double focal_px_;
  double centre_u_px_;
  double centre_v_px_;
  double cos_tilt_;
  double sin_tilt_;
  double height_m_;
};

}  // namespace seeker::vision
