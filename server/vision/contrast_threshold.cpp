#include "server/vision/contrast_threshold.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace seeker::vision {
namespace {

constexpr double kBlur_px = 0.8;  ///< twice, so that the difference is that of sigma 0.8 and 1.13
constexpr int kStripe_px = 64;    ///< every third stripe of as many rows is examined
const cv::Size kKernel(5, 5);
constexpr double kGreyLevels = 255.0;
constexpr int kLayersPerOctave = 3;  ///< SIFT compares contrasts times its layers with the threshold
/// A picture that has a quarter fewer than wanted does without a lower threshold, which costs time and finds weaker
/// points; at 0.75 key points an extremum, as many extrema as key points wanted are enough.
constexpr double kExtremaPerWanted = 1.0;
/// In a picture with far more extrema than are kept only the strongest are used: at 0.75 key points per extremum these
/// are then enough.
constexpr double kPlenty = 1.75;

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

/// Adds the contrasts of all extrema of at least `lowest`.
void add_extrema(const cv::Mat& difference, float lowest, float edge, std::vector<float>& found) {
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
}

/// Contrasts of extrema, and the share of the picture that was searched.
struct Sample {
  std::vector<float> contrasts;
  double share = 0.0;
};

/// From every third stripe of the picture.
Sample sample_extrema(const cv::Mat& grey, float lowest, float edge) {
  Sample sample;
  cv::Mat half;
  cv::Mat fine;
  cv::Mat coarse;
  const int stripe = std::min(kStripe_px, grey.rows);
  for (int top = 0; top + stripe <= grey.rows; top += 3 * stripe) {
    cv::resize(grey.rowRange(top, top + stripe), half, cv::Size(), 0.5, 0.5, cv::INTER_AREA);
    half.convertTo(half, CV_32F);
    cv::GaussianBlur(half, fine, kKernel, kBlur_px);
    cv::GaussianBlur(fine, coarse, kKernel, kBlur_px);
    add_extrema(coarse - fine, lowest, edge, sample.contrasts);
    sample.share += static_cast<double>(stripe) / grey.rows;
  }
  return sample;
}

}  // namespace

double pick_contrast_threshold(const cv::Mat& grey, const DetectorParams& params) {
  const double lowest = std::ldexp(params.contrast_threshold, -params.contrast_halvings);
  Sample sample = sample_extrema(grey, static_cast<float>(lowest * kGreyLevels / kLayersPerOctave),
                                 static_cast<float>(params.edge_threshold));
  // The threshold that `count` of the extrema pass; below the lowest where there are not as many.
  const auto threshold_of = [&sample](double count) {
    std::vector<float>& found = sample.contrasts;
    const auto n = static_cast<std::size_t>(sample.share * count);
    if (n >= found.size()) {
      return 0.0;
    }
    const auto nth = found.begin() + static_cast<std::ptrdiff_t>(n);
    std::nth_element(found.begin(), nth, found.end(), std::greater<>());
    return static_cast<double>(*nth) * kLayersPerOctave / kGreyLevels;
  };
  const double described = kPlenty * std::max(params.wanted, params.at_most);
  const double enough = threshold_of(kExtremaPerWanted * params.wanted);
  double threshold = params.contrast_threshold;
  while (threshold > std::max(lowest, enough)) {
    threshold *= 0.5;
  }
  return std::max(threshold, threshold_of(described));
}

}  // namespace seeker::vision
