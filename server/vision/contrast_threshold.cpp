#include "server/vision/contrast_threshold.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace seeker::vision {
namespace {

constexpr double kBlur_px = 0.8;  ///< twice, so that the difference is that of sigma 0.8 and 1.13
constexpr double kGreyLevels = 255.0;
constexpr int kLayersPerOctave = 3;  ///< SIFT compares contrasts times its layers with the threshold
/// A picture that has a quarter fewer than wanted does without a lower threshold, which costs time and finds weaker
/// points; at 0.75 key points an extremum, as many extrema as key points wanted are enough.
constexpr double kExtremaPerWanted = 1.0;

/// |contrast| of an extremum of the 3x3 pixels around `u`, or 0.
float peak(const float* above, const float* row, const float* below, int u) {
  const float sign = row[u] > 0.0F ? 1.0F : -1.0F;
  const float value = sign * row[u];
  const auto beats = [&](const float* other, int k) { return value > sign * other[u + k]; };
  const bool highest = beats(row, -1) && beats(row, 1) && beats(above, 0) && beats(below, 0) && beats(above, -1) &&
                       beats(above, 1) && beats(below, -1) && beats(below, 1);
  return highest ? value : 0.0F;
}

/// Curved in both directions, as SIFT wants it (ratio of principal curvatures at most `edge`).
bool is_corner(const float* above, const float* row, const float* below, int u, float edge) {
  constexpr float kQuarter = 0.25F;
  const float uu = row[u - 1] + row[u + 1] - 2.0F * row[u];
  const float vv = above[u] + below[u] - 2.0F * row[u];
  const float uv = kQuarter * (below[u + 1] - below[u - 1] - above[u + 1] + above[u - 1]);
  const float det = uu * vv - uv * uv;
  return det > 0.0F && (uu + vv) * (uu + vv) * edge < (edge + 1.0F) * (edge + 1.0F) * det;
}

/// Contrasts of all extrema of at least `lowest`.
std::vector<float> extrema(const cv::Mat& difference, float lowest, float edge) {
  std::vector<float> found;
  for (int v = 1; v + 1 < difference.rows; ++v) {
    const auto* above = difference.ptr<float>(v - 1);
    const auto* row = difference.ptr<float>(v);
    const auto* below = difference.ptr<float>(v + 1);
    for (int u = 1; u + 1 < difference.cols; ++u) {
      if (std::abs(row[u]) < lowest) {
        continue;
      }
      const float contrast = peak(above, row, below, u);
      if (contrast > 0.0F && is_corner(above, row, below, u, edge)) {
        found.push_back(contrast);
      }
    }
  }
  return found;
}

}  // namespace

double pick_contrast_threshold(const cv::Mat& grey, const DetectorParams& params) {
  if (params.contrast_halvings == 0 || params.wanted == 0) {
    return params.contrast_threshold;
  }
  cv::Mat half;
  cv::resize(grey, half, cv::Size(), 0.5, 0.5, cv::INTER_AREA);
  half.convertTo(half, CV_32F);
  cv::Mat fine;
  cv::Mat coarse;
  cv::GaussianBlur(half, fine, cv::Size(), kBlur_px);
  cv::GaussianBlur(fine, coarse, cv::Size(), kBlur_px);
  const double lowest = std::ldexp(params.contrast_threshold, -params.contrast_halvings);
  const auto in_greys = [](double threshold) { return static_cast<float>(threshold * kGreyLevels / kLayersPerOctave); };
  const std::vector<float> found = extrema(coarse - fine, in_greys(lowest), static_cast<float>(params.edge_threshold));
  double threshold = params.contrast_threshold;
  for (; threshold > lowest; threshold *= 0.5) {
    const auto enough = std::count_if(found.begin(), found.end(),
                                      [limit = in_greys(threshold)](float contrast) { return contrast >= limit; });
    if (static_cast<double>(enough) >= kExtremaPerWanted * params.wanted) {
      break;
    }
  }
  return threshold;
}

}  // namespace seeker::vision
