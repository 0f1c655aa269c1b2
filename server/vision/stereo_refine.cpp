#include "server/vision/stereo_refine.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace seeker::vision {
namespace {

constexpr int kHalfWindow_px = 5;  // 11x11
constexpr int kSearch_px = 2;
constexpr int kWindow = (2 * kHalfWindow_px + 1) * (2 * kHalfWindow_px + 1);
constexpr int kSteps = 2 * kSearch_px + 1;
constexpr int kMinVariance = 4;  // squared grey levels: noise alone has no place

bool holds_window(const cv::Mat& picture, int u, int v, int margin) {
  return u - margin >= 0 && u + margin < picture.cols && v - kHalfWindow_px >= 0 && v + kHalfWindow_px < picture.rows;
}

/// Zero-mean normalised correlation of the windows around two pixels.
std::optional<double> correlation(const cv::Mat& left, const cv::Mat& right, int u_left, int u_right, int v) {
  int sum_left = 0;
  int sum_right = 0;
  int squares_left = 0;
  int squares_right = 0;
  int products = 0;
  for (int row = v - kHalfWindow_px; row <= v + kHalfWindow_px; ++row) {
    const auto* a = left.ptr<std::uint8_t>(row) + u_left - kHalfWindow_px;
    const auto* b = right.ptr<std::uint8_t>(row) + u_right - kHalfWindow_px;
    for (int k = 0; k <= 2 * kHalfWindow_px; ++k) {
      sum_left += a[k];
      sum_right += b[k];
      squares_left += a[k] * a[k];
      squares_right += b[k] * b[k];
      products += a[k] * b[k];
    }
  }
  const double spread_left = static_cast<double>(squares_left) * kWindow - static_cast<double>(sum_left) * sum_left;
  const double spread_right = static_cast<double>(squares_right) * kWindow - static_cast<double>(sum_right) * sum_right;
  if (std::min(spread_left, spread_right) < static_cast<double>(kMinVariance) * kWindow * kWindow) {
    return std::nullopt;
  }
  return (static_cast<double>(products) * kWindow - static_cast<double>(sum_left) * sum_right) /
         std::sqrt(spread_left * spread_right);
}

}  // namespace

std::optional<RefinedDisparity> refine_disparity(const cv::Mat& left, const cv::Mat& right, double u_px, double v_px,
                                                 double disparity_px) {
  const int u_left = cvRound(u_px);
  const int v = cvRound(v_px);
  const int start = u_left - cvRound(disparity_px);
  if (!holds_window(left, u_left, v, kHalfWindow_px) || !holds_window(right, start, v, kHalfWindow_px + kSearch_px)) {
    return std::nullopt;
  }
  std::array<double, kSteps> scores{};
  for (int step = 0; step < kSteps; ++step) {
    const auto score = correlation(left, right, u_left, start + step - kSearch_px, v);
    if (!score) {
      return std::nullopt;
    }
    scores[static_cast<std::size_t>(step)] = *score;
  }
  const auto best = static_cast<std::size_t>(std::max_element(scores.begin(), scores.end()) - scores.begin());
  if (best == 0 || best + 1 == kSteps) {
    return std::nullopt;
  }
  const double curvature = scores[best - 1] + scores[best + 1] - 2.0 * scores[best];
  if (!(curvature < 0.0)) {
    return std::nullopt;
  }
  const double fraction = 0.5 * (scores[best - 1] - scores[best + 1]) / curvature;
  const double u_right = start + static_cast<double>(best) - kSearch_px + fraction;
  return RefinedDisparity{u_left - u_right, scores[best]};
}

}  // namespace seeker::vision
