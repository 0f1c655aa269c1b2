#include "server/vision/scene_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include <opencv2/imgproc.hpp>

#include "common/core/angle.hpp"
#include "server/vision/photo_view.hpp"
#include "server/vision/picture.hpp"

namespace seeker::vision {
namespace {

/// Columns beyond one full circle: the widest target that may lie across the seam.
constexpr double kOverlap_rad = 0.6;

PixelBox enclosing_box(const std::array<PixelPoint, 8>& points) {
  double left = points[0].u_px;
  double right = left;
  double top = points[0].v_px;
  double bottom = top;
  for (const PixelPoint& p : points) {
    left = std::min(left, p.u_px);
    right = std::max(right, p.u_px);
    top = std::min(top, p.v_px);
    bottom = std::max(bottom, p.v_px);
  }
  const int left_px = static_cast<int>(std::floor(left + 0.5));
  const int top_px = static_cast<int>(std::floor(top + 0.5));
  return {left_px, top_px, std::max(1, static_cast<int>(std::ceil(right - 0.5)) - left_px + 1),
          std::max(1, static_cast<int>(std::ceil(bottom - 0.5)) - top_px + 1)};
}

PixelPoint to_pixel(const cv::Point2d& p) { return {p.x, p.y}; }

double distance_px(const PixelPoint& a, const PixelPoint& b) { return std::hypot(a.u_px - b.u_px, a.v_px - b.v_px); }

/// Corners and the middles of the sides: in the original picture the sides of an unwrapped box are curved.
std::array<cv::Point2d, 8> outline(const std::array<cv::Point2d, 4>& c) {
  return {c[0], 0.5 * (c[0] + c[1]), c[1], 0.5 * (c[1] + c[2]), c[2], 0.5 * (c[2] + c[3]), c[3], 0.5 * (c[3] + c[0])};
}

}  // namespace

SceneView::SceneView(const ViewParams& params) : params_(params) {
  if (params_.omni) {
    camera_.emplace(*params_.omni);
    build_maps();
  }
}

void SceneView::build_maps() {
  const OmniCameraParams& p = camera_->params();
  const double horizon_px = camera_->radius_of_elevation_px(0.0).value_or(p.outer_radius_px);
  scale_px_per_rad_ = params_.panorama_scale * horizon_px;
  const double top_tan = std::tan(camera_->elevation_rad(p.outer_radius_px));
  const double bottom_tan = std::tan(std::max(params_.min_elevation_rad, camera_->elevation_rad(p.inner_radius_px)));
  horizon_row_ = scale_px_per_rad_ * top_tan;
  const int rows = std::max(1, static_cast<int>(scale_px_per_rad_ * (top_tan - bottom_tan)));
  const int columns = std::max(1, static_cast<int>(scale_px_per_rad_ * (kTwoPi + kOverlap_rad)));
  cv::Mat map(rows, columns, CV_32FC2);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const PixelPoint pixel = to_original({static_cast<double>(column), static_cast<double>(row)});
      map.at<cv::Vec2f>(row, column) = {static_cast<float>(pixel.u_px), static_cast<float>(pixel.v_px)};
    }
  }
  cv::convertMaps(map, cv::Mat(), map_xy_, map_weight_, CV_16SC2);
}

double SceneView::bearing_of_column(double column) const {
  return wrap_angle(kPi - (column + 0.5) / scale_px_per_rad_);
}

double SceneView::bearing_base_rad(const cv::Point2d& p_working, const cv::Size& working) const {
  return camera_ ? bearing_of_column(p_working.x)
                 : PhotoView(params_, working.width, working.height).bearing_rad(p_working.x, p_working.y);
}

int SceneView::circle_columns() const {
  return camera_ ? static_cast<int>(scale_px_per_rad_ * kTwoPi) : std::numeric_limits<int>::max();
}

double SceneView::elevation_of_row(double row) const {
  const OmniCameraParams& p = camera_->params();
  return std::clamp(std::atan((horizon_row_ - row - 0.5) / scale_px_per_rad_),
                    camera_->elevation_rad(p.inner_radius_px), camera_->elevation_rad(p.outer_radius_px));
}

PixelPoint SceneView::to_original(const cv::Point2d& panorama) const {
  const auto pixel = camera_->pixel_of(bearing_of_column(panorama.x), elevation_of_row(panorama.y));
  SEEKER_ASSERT(pixel.has_value());
  return *pixel;
}

Result<cv::Mat> SceneView::working_picture(const Image& picture) const {
  if (picture.empty()) {
    return fail(Errc::kInvalidArgument, "the picture has no pixels: check the camera or the file");
  }
  if (!camera_) {
    return to_grey_mat(picture);
  }
  if (const Status size = check_size(camera_->params(), picture); !size) {
    return tl::unexpected<Error>(size.error());
  }
  cv::Mat panorama;
  cv::remap(to_grey_mat(picture), panorama, map_xy_, map_weight_, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return panorama;
}

double SceneView::reference_area_px(const Image& picture) const {
  const double scale = camera_ ? params_.panorama_scale : 1.0;
  return scale * scale * picture.width_px() * picture.height_px();
}

void SceneView::locate(const std::array<cv::Point2d, 4>& corners, const cv::Size& working, double height_m,
                       Sighting& sighting) const {
  if (camera_) {
    locate_in_panorama(corners, height_m, sighting);
  } else {
    locate_in_photo(corners, working, height_m, sighting);
  }
}

void SceneView::locate_in_panorama(const std::array<cv::Point2d, 4>& corners, double height_m,
                                   Sighting& sighting) const {
  const cv::Point2d centre = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
  const PixelPoint pixel = to_original(centre);
  sighting.u_px = pixel.u_px;
  sighting.v_px = pixel.v_px;
  sighting.bearing_base_rad = camera_->bearing_base_rad(pixel);
  sighting.elevation_rad = elevation_of_row(centre.y);
  const cv::Point2d up = 0.5 * (corners[0] + corners[1] - corners[2] - corners[3]);
  const double tilt = std::atan2(-up.x, -up.y);
  sighting.rotation_rad = wrap_angle(sighting.bearing_base_rad - camera_->params().alignment_rad + tilt);
  sighting.range_m = height_m * scale_px_per_rad_ / std::max(1.0, cv::norm(up));
  std::array<PixelPoint, 8> points;
  const std::array<cv::Point2d, 8> sides = outline(corners);
  std::transform(sides.begin(), sides.end(), points.begin(), [this](const auto& p) { return to_original(p); });
  sighting.box = enclosing_box(points);
  sighting.size = {distance_px(points[7], points[3]), distance_px(points[1], points[5])};
}

void SceneView::locate_in_photo(const std::array<cv::Point2d, 4>& corners, const cv::Size& working, double height_m,
                                Sighting& sighting) const {
  const cv::Point2d centre = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
  const PhotoView view(params_, working.width, working.height);
  sighting.u_px = centre.x;
  sighting.v_px = centre.y;
  sighting.bearing_base_rad = view.bearing_rad(centre.x, centre.y);
  const cv::Point2d up = 0.5 * (corners[0] + corners[1] - corners[2] - corners[3]);
  sighting.rotation_rad = std::atan2(-up.x, -up.y);
  sighting.range_m = height_m * view.focal_px() / std::max(1.0, cv::norm(up));
  std::array<PixelPoint, 8> points;
  const std::array<cv::Point2d, 8> sides = outline(corners);
  std::transform(sides.begin(), sides.end(), points.begin(), to_pixel);
  sighting.box = enclosing_box(points);
  sighting.size = {distance_px(points[7], points[3]), distance_px(points[1], points[5])};
}

}  // namespace seeker::vision
