/// \file
/// Directions of the pixels of a plain photograph: a camera without roll, level or tilted down at the floor.
#pragma once

#include <optional>

#include "server/vision/recogniser_params.hpp"

namespace seeker::vision {

class PhotoView {
 public:
  /// Creates the view for pictures of this size, which must not be empty (asserted).
  PhotoView(const ViewParams& params, int width_px, int height_px);

  [[nodiscard]] double focal_px() const { return focal_px_; }
  /// Bearing in the plane of the floor, left positive, 0 straight ahead.
  [[nodiscard]] double bearing_rad(double u_px, double v_px) const;
  /// Distance on the floor from the point below the camera to where the pixel shows the floor. No value at or above the
  /// horizon, nor where the camera's height is not known.
  [[nodiscard]] std::optional<double> floor_range_m(double u_px, double v_px) const;
  /// Length that one pixel spans on a plane across the optical axis, at the distance of that point of the floor.
  [[nodiscard]] std::optional<double> floor_scale_m(double u_px, double v_px) const;

 private:
  struct Ray {
    double ahead = 1.0;  ///< along the floor
    double right = 0.0;
    double down = 0.0;  ///< the three components per unit along the optical axis
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
