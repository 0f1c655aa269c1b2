#include "server/vision/homography.hpp"

#include <cmath>

#include <opencv2/calib3d.hpp>

namespace seeker::vision {
namespace {

constexpr std::size_t kMinPairs = 4;
constexpr double kMinDepth = 1e-6;  // of a projective point that is still in front
/// Opposite sides of the outline may differ by this factor: more is a view no camera has of a flat target.
constexpr double kMaxSideRatio = 4.0;

std::optional<cv::Point2d> project(const cv::Matx33d& h, const cv::Point2d& p) {
  const double w = h(2, 0) * p.x + h(2, 1) * p.y + h(2, 2);
  if (!(w > kMinDepth)) {
    return std::nullopt;
  }
  return cv::Point2d((h(0, 0) * p.x + h(0, 1) * p.y + h(0, 2)) / w, (h(1, 0) * p.x + h(1, 1) * p.y + h(1, 2)) / w);
}

std::optional<cv::Matx33d> estimate(const std::vector<cv::Point2f>& from, const std::vector<cv::Point2f>& to,
                                    int method, double reprojection_px) {
  const cv::Mat model = cv::findHomography(from, to, method, reprojection_px);
  if (model.rows != 3 || model.cols != 3 || model.type() != CV_64F || !cv::checkRange(model)) {
    return std::nullopt;
  }
  return cv::Matx33d(model.ptr<double>());
}

std::vector<std::size_t> agreeing(const cv::Matx33d& h, const std::vector<cv::Point2f>& from,
                                  const std::vector<cv::Point2f>& to, double reprojection_px) {
  std::vector<std::size_t> inliers;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const auto seen = project(h, from[i]);
    if (seen && cv::norm(*seen - cv::Point2d(to[i])) <= reprojection_px) {
      inliers.push_back(i);
    }
  }
  return inliers;
}

std::vector<cv::Point2f> pick(const std::vector<cv::Point2f>& points, const std::vector<std::size_t>& indices) {
  std::vector<cv::Point2f> out;
  out.reserve(indices.size());
  for (const std::size_t i : indices) {
    out.push_back(points[i]);
  }
  return out;
}

/// Convex and with the same orientation as the target's picture (a mirrored target cannot be visible).
bool convex_and_unmirrored(const std::array<cv::Point2d, 4>& c) {
  for (std::size_t i = 0; i < c.size(); ++i) {
    const cv::Point2d side = c[(i + 1) % 4] - c[i];
    const cv::Point2d next = c[(i + 2) % 4] - c[(i + 1) % 4];
    if (!(side.cross(next) > 0.0)) {
      return false;
    }
  }
  return true;
}

bool sensible_size(const std::array<cv::Point2d, 4>& c, const cv::Size& target, double max_scale_change) {
  const auto side = [&c](std::size_t i) { return cv::norm(c[(i + 1) % 4] - c[i]); };
  for (std::size_t i = 0; i < 4; ++i) {
    const double scale = side(i) / (i % 2 == 0 ? target.width : target.height);
    if (scale > max_scale_change || scale < 1.0 / max_scale_change || side(i) > kMaxSideRatio * side((i + 2) % 4)) {
      return false;
    }
  }
  return true;
}

std::optional<std::array<cv::Point2d, 4>> outline(const cv::Matx33d& h, const cv::Size& size) {
  const std::array<cv::Point2d, 4> picture = {cv::Point2d(-0.5, -0.5), cv::Point2d(size.width - 0.5, -0.5),
                                              cv::Point2d(size.width - 0.5, size.height - 0.5),
                                              cv::Point2d(-0.5, size.height - 0.5)};
  std::array<cv::Point2d, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto seen = project(h, picture[i]);
    if (!seen) {
      return std::nullopt;
    }
    corners[i] = *seen;
  }
  return corners;
}

}  // namespace

std::optional<PlanarFit> fit_planar(const std::vector<cv::Point2f>& target_points,
                                    const std::vector<cv::Point2f>& scene_points, const cv::Size& target_size,
                                    const FeatureParams& params) {
  if (target_points.size() < kMinPairs || target_points.size() != scene_points.size()) {
    return std::nullopt;
  }
  const auto rough = estimate(target_points, scene_points, cv::RANSAC, params.reprojection_px);
  if (!rough) {
    return std::nullopt;
  }
  const std::vector<std::size_t> first = agreeing(*rough, target_points, scene_points, params.reprojection_px);
  if (first.size() < kMinPairs) {
    return std::nullopt;
  }
  const auto refined = estimate(pick(target_points, first), pick(scene_points, first), 0, params.reprojection_px);
  if (!refined) {
    return std::nullopt;
  }
  PlanarFit fit{*refined, {}, agreeing(*refined, target_points, scene_points, params.reprojection_px)};
  const auto corners = outline(*refined, target_size);
  if (!corners || static_cast<int>(fit.inliers.size()) < params.min_inliers ||
      static_cast<double>(fit.inliers.size()) < params.min_inlier_share * static_cast<double>(target_points.size()) ||
      !convex_and_unmirrored(*corners) || !sensible_size(*corners, target_size, params.max_scale_change)) {
    return std::nullopt;
  }
  fit.corners = *corners;
  return fit;
}

}  // namespace seeker::vision
