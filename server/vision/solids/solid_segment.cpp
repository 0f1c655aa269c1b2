#include "server/vision/solids/solid_segment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "common/core/assert.hpp"
#include "server/vision/binarise.hpp"

namespace seeker::vision {
namespace {

/// Divides the picture by its own wide blur: what the lamp does is slow, what a solid does is not. The blur is made in
/// a small copy; nothing of its size is lost there.
cv::Mat even_light(const cv::Mat& grey, double sigma_px) {
  constexpr int kShrink = 8;
  cv::Mat log_light;
  grey.convertTo(log_light, CV_32F, 1.0, 1.0);
  cv::log(log_light, log_light);
  cv::Mat coarse;
  cv::resize(log_light, coarse, {}, 1.0 / kShrink, 1.0 / kShrink, cv::INTER_AREA);
  cv::GaussianBlur(coarse, coarse, {}, sigma_px / kShrink);
  cv::resize(coarse, coarse, grey.size(), 0.0, 0.0, cv::INTER_LINEAR);
  log_light -= coarse;
  cv::Mat even;
  cv::exp(log_light, even);
  constexpr double kMiddle = 90.0;
  even.convertTo(even, CV_8U, kMiddle);
  return even;
}

cv::Mat kernel(int side_px) { return cv::getStructuringElement(cv::MORPH_ELLIPSE, {side_px, side_px}); }

/// Pixels of the largest region of a solid's size that the border does not cut; empty: none.
cv::Mat largest(const cv::Mat& binary, const SegmentParams& params) {
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat centres;
  const int count = cv::connectedComponentsWithStats(binary, labels, stats, centres);
  int best = 0;
  int best_area = static_cast<int>(std::ceil(params.min_area * static_cast<double>(binary.total())));
  for (int i = 1; i < count; ++i) {
    const cv::Rect box(stats.at<int>(i, cv::CC_STAT_LEFT), stats.at<int>(i, cv::CC_STAT_TOP),
                       stats.at<int>(i, cv::CC_STAT_WIDTH), stats.at<int>(i, cv::CC_STAT_HEIGHT));
    const bool cut = box.x == 0 || box.y == 0 || box.br().x == binary.cols || box.br().y == binary.rows;
    const int area = stats.at<int>(i, cv::CC_STAT_AREA);
    if (!cut && area >= best_area && area <= params.max_area * static_cast<double>(binary.total())) {
      best = i;
      best_area = area;
    }
  }
  return best == 0 ? cv::Mat() : cv::Mat(labels == best);
}

cv::Mat above(const cv::Mat& smooth, double level, const SegmentParams& params) {
  cv::Mat binary = smooth > level;
  cv::morphologyEx(binary, binary, cv::MORPH_OPEN, kernel(params.opening_px));
  cv::morphologyEx(binary, binary, cv::MORPH_CLOSE, kernel(params.closing_px));
  return binary;
}

/// Grey values of the brightest faces and of the floor around them.
struct Contrast {
  double faces = 0.0;
  double floor = 0.0;
  double floor_sigma = 0.0;
};

Contrast contrast_of(const cv::Mat& smooth, const cv::Mat& bright) {
  constexpr int kAround_px = 41;
  cv::Mat floor;
  cv::dilate(bright, floor, kernel(kAround_px));
  floor = ~floor;
  cv::Scalar mean;
  cv::Scalar sigma;
  cv::meanStdDev(smooth, mean, sigma, floor);
  return {cv::mean(smooth, bright)[0], mean[0], sigma[0]};
}

/// Otsu's threshold parts the bright faces from the rest. A lower one, from the floor around them, has the dim ones.
double face_level(const Contrast& c, const SegmentParams& params) {
  return c.floor + std::max(params.floor_sigmas * c.floor_sigma, params.face_share * (c.faces - c.floor));
}

void fill_hull(SolidRegion& region) {
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(region.mask.clone(), outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_SIMPLE);
  std::vector<cv::Point> points;
  for (const auto& outline : outlines) {
    points.insert(points.end(), outline.begin(), outline.end());
  }
  std::vector<cv::Point> hull;
  cv::convexHull(points, hull);
  cv::fillConvexPoly(region.mask, hull, cv::Scalar(255));
  region.box = cv::boundingRect(hull);
}

}  // namespace

std::optional<SolidRegion> segment_solid(const cv::Mat& grey, const SegmentParams& params) {
  SEEKER_ASSERT(grey.type() == CV_8UC1 && !grey.empty());
  cv::Mat even;
  cv::medianBlur(grey, even, 3);
  even = even_light(even, params.light_sigma_px);
  const std::array<std::uint8_t, 256> table = stretch_table(histogram(even), params.stretch_low, params.stretch_high);
  cv::LUT(even, cv::Mat(1, 256, CV_8U, const_cast<std::uint8_t*>(table.data())), even);
  cv::Mat smooth;
  constexpr double kSmooth_px = 2.0;
  cv::GaussianBlur(even, smooth, {}, kSmooth_px);
  const std::optional<int> level = otsu_threshold(histogram(smooth), 0, 255);
  if (!level) {
    return std::nullopt;
  }
  const cv::Mat bright = largest(above(smooth, *level, params), params);
  if (bright.empty()) {
    return std::nullopt;
  }
  // Of an empty floor, Otsu's threshold parts noise from noise.
  const Contrast contrast = contrast_of(smooth, bright);
  if (contrast.faces - contrast.floor < params.contrast_sigmas * contrast.floor_sigma) {
    return std::nullopt;
  }
  SolidRegion region;
  const double low = face_level(contrast, params);
  region.mask = low < *level ? largest(above(smooth, low, params), params) : bright;
  if (region.mask.empty() || cv::countNonZero(region.mask & bright) == 0) {
    region.mask = bright;
  }
  fill_hull(region);
  region.even = even;
  return region;
}

}  // namespace seeker::vision
