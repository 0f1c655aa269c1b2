/// \file
/// Where metres lie on the picture of a map.
#pragma once

#include "common/image/map_picture.hpp"

namespace seeker::image {

/// A window of the frame `map` on pixels: y points up there and down here.
struct MapView {
  Point2 low = Point2::Zero();   ///< lower left corner, in the frame `map`
  Point2 high = Point2::Zero();  ///< upper right corner
  double px_per_m = 1.0;
  int width_px = 1;
  int height_px = 1;

  [[nodiscard]] Point2 to_px(const Point2& p_map) const {
    return {(p_map.x() - low.x()) * px_per_m, (high.y() - p_map.y()) * px_per_m};
  }
  [[nodiscard]] Point2 to_map(const Point2& p_px) const {
    return {low.x() + p_px.x() / px_per_m, high.y() - p_px.y() / px_per_m};
  }
  [[nodiscard]] Matrix2 to_px2(const Matrix2& covariance_m2) const {
    const Matrix2 flip = Point2(px_per_m, -px_per_m).asDiagonal();
    return flip * covariance_m2 * flip;
  }
};

/// A window that holds everything the scene knows.
[[nodiscard]] Result<MapView> fit_view(const MapScene& scene, const MapPictureOptions& options);

}  // namespace seeker::image
