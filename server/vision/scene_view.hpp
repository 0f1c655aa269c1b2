/// \file
/// The working picture in which targets are searched: a photograph unchanged, or the cylindrical panorama of an
/// omnidirectional picture, in which "up" is outward and an upright target keeps its proportions at any bearing and
/// range (spec S3.4: the template rotated to the radial direction, for all directions at once).
#pragma once

#include <opencv2/core.hpp>

#include "server/vision/recogniser_params.hpp"
#include "server/vision/sighting.hpp"

namespace seeker::vision {

/// Rows of the panorama are equidistant in tan(elevation), columns in bearing, both with the same scale; the first
/// column is at +180 deg, and columns beyond one full circle repeat the beginning so that no target is cut by the seam.
class SceneView {
 public:
  /// Requires a valid omnidirectional camera where one is given (asserted).
  explicit SceneView(const ViewParams& params);

  /// The working picture, CV_8UC1. Fails with kInvalidArgument when the picture is empty or has not the calibrated
  /// size.
  [[nodiscard]] Result<cv::Mat> working_picture(const Image& picture) const;
  /// The area to which the limits on regions refer, in pixels of the working picture.
  [[nodiscard]] double reference_area_px(const Image& picture) const;
  /// Sets position, size, bearing, elevation and range of a sighting by a quadrilateral in the working picture (corners
  /// top left, top right, bottom right, bottom left of the target) and the target's real height.
  void locate(const std::array<cv::Point2d, 4>& corners, const cv::Size& working, double height_m,
              Sighting& sighting) const;
  /// The bearing of a point of a working picture of this size, frame `base`, left positive, in (-pi, pi].
  [[nodiscard]] double bearing_base_rad(const cv::Point2d& p_working, const cv::Size& working) const;
  /// Number of columns of a panorama that show one full circle; of a photograph more than it has.
  [[nodiscard]] int circle_columns() const;
  /// Whether the picture is unwrapped.
  [[nodiscard]] bool panoramic() const { return camera_.has_value(); }

 private:
  void build_maps();
  void locate_in_panorama(const std::array<cv::Point2d, 4>& corners, double height_m, Sighting& sighting) const;
  void locate_in_photo(const std::array<cv::Point2d, 4>& corners, const cv::Size& working, double height_m,
                       Sighting& sighting) const;
  [[nodiscard]] PixelPoint to_original(const cv::Point2d& panorama) const;
  [[nodiscard]] double bearing_of_column(double column) const;
  [[nodiscard]] double elevation_of_row(double row) const;

  ViewParams params_;
  std::optional<OmniCamera> camera_;
  double scale_px_per_rad_ = 0.0;
  double horizon_row_ = 0.0;
  cv::Mat map_xy_;      // CV_16SC2
  cv::Mat map_weight_;  // CV_16UC1
};

}  // namespace seeker::vision
