#include "server/vision/patch.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace seeker::vision {
namespace {

constexpr int kMaxLevels = 6;
constexpr int kMinLevelSide_px = 8;

/// Where one sample lies along an axis: between pixel `low` and `high`.
struct Tap {
  int low = 0;
  int high = 0;
  float weight = 0.0F;  ///< of `high`
};

void make_taps(double start, double length, int count, double level_scale, int size, std::vector<Tap>& taps) {
  taps.clear();
  for (int i = 0; i < count; ++i) {
    const double at = std::clamp((start + (i + 0.5) * length / count) / level_scale - 0.5, 0.0, size - 1.0);
    const int low = static_cast<int>(at);
    taps.push_back({low, std::min(low + 1, size - 1), static_cast<float>(at - low)});
  }
}

}  // namespace

GreyPyramid::GreyPyramid(const cv::Mat& grey) {
  levels_.push_back(grey);
  while (levels_.size() < kMaxLevels && std::min(levels_.back().rows, levels_.back().cols) >= 2 * kMinLevelSide_px) {
    cv::Mat half;
    cv::resize(levels_.back(), half, cv::Size(levels_.back().cols / 2, levels_.back().rows / 2), 0.0, 0.0,
               cv::INTER_AREA);
    levels_.push_back(half);
  }
}

void GreyPyramid::sample(const cv::Rect2d& box, int columns, int rows, std::vector<float>& values) const {
  const double cell = std::max(box.width / columns, box.height / rows);
  const int wanted = cell > 2.0 ? static_cast<int>(std::log2(cell)) : 0;
  const auto level = static_cast<std::size_t>(std::clamp(wanted, 0, static_cast<int>(levels_.size()) - 1));
  const cv::Mat& picture = levels_[level];
  const double scale = std::exp2(static_cast<double>(level));
  std::vector<Tap> across;
  std::vector<Tap> down;
  make_taps(box.x, box.width, columns, scale, picture.cols, across);
  make_taps(box.y, box.height, rows, scale, picture.rows, down);
  values.clear();
  for (const Tap& v : down) {
    const auto* low = picture.ptr<std::uint8_t>(v.low);
    const auto* high = picture.ptr<std::uint8_t>(v.high);
    for (const Tap& u : across) {
      const float left = static_cast<float>(low[u.low]) + v.weight * static_cast<float>(high[u.low] - low[u.low]);
      const float right = static_cast<float>(low[u.high]) + v.weight * static_cast<float>(high[u.high] - low[u.high]);
      values.push_back(left + u.weight * (right - left));
    }
  }
}

TemplatePatch::TemplatePatch(const cv::Mat& grey, const cv::Mat& mask, int columns, int rows)
    : columns_(columns), rows_(rows) {
  cv::Mat scaled;
  cv::resize(grey, scaled, cv::Size(columns, rows), 0.0, 0.0, cv::INTER_AREA);
  scaled.convertTo(scaled, CV_32F);
  cv::Mat small_mask(rows, columns, CV_8UC1, cv::Scalar(1));
  if (!mask.empty()) {
    cv::resize(mask, small_mask, cv::Size(columns, rows), 0.0, 0.0, cv::INTER_AREA);
    cv::threshold(small_mask, small_mask, 127.0, 1.0, cv::THRESH_BINARY);
  }
  mask_count_ = cv::countNonZero(small_mask);
  const double mean = mask_count_ > 0.0 ? cv::mean(scaled, small_mask)[0] : 0.0;
  double squares = 0.0;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const bool counts = small_mask.at<std::uint8_t>(row, column) != 0;
      const double value = counts ? scaled.at<float>(row, column) - mean : 0.0;
      mask_.push_back(counts ? 1.0F : 0.0F);
      centred_.push_back(static_cast<float>(value));
      squares += value * value;
    }
  }
  const float norm = squares > 0.0 ? static_cast<float>(1.0 / std::sqrt(squares)) : 0.0F;
  std::transform(centred_.begin(), centred_.end(), centred_.begin(), [norm](float v) { return v * norm; });
  prepare_gradients(scaled, small_mask);
}

void TemplatePatch::prepare_gradients(const cv::Mat& scaled, const cv::Mat& mask) {
  const auto counts = [&mask](int row, int column) { return mask.at<std::uint8_t>(row, column) != 0; };
  double squares = 0.0;
  for (int row = 1; row + 1 < rows_; ++row) {
    for (int column = 1; column + 1 < columns_; ++column) {
      if (!counts(row, column) || !counts(row - 1, column) || !counts(row + 1, column) || !counts(row, column - 1) ||
          !counts(row, column + 1)) {
        continue;
      }
      const float x = scaled.at<float>(row, column + 1) - scaled.at<float>(row, column - 1);
      const float y = scaled.at<float>(row + 1, column) - scaled.at<float>(row - 1, column);
      gradients_.push_back({static_cast<std::size_t>(row * columns_ + column), x, y});
      squares += static_cast<double>(x * x + y * y);
    }
  }
  const float norm = squares > 0.0 ? static_cast<float>(1.0 / std::sqrt(squares)) : 0.0F;
  for (Gradient& g : gradients_) {
    g.x *= norm;
    g.y *= norm;
  }
}

double TemplatePatch::ncc(const std::vector<float>& values, double min_contrast) const {
  float sum = 0.0F;
  float squares = 0.0F;
  float product = 0.0F;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float masked = values[i] * mask_[i];
    sum += masked;
    squares += masked * values[i];
    product += centred_[i] * values[i];
  }
  if (mask_count_ < 1.0) {
    return 0.0;
  }
  const double spread = squares - static_cast<double>(sum) * sum / mask_count_;
  if (spread < min_contrast * min_contrast * mask_count_ || spread <= 0.0) {
    return 0.0;
  }
  return std::clamp(product / std::sqrt(spread), -1.0, 1.0);
}

double TemplatePatch::gradient_ncc(const std::vector<float>& values) const {
  const auto width = static_cast<std::size_t>(columns_);
  double squares = 0.0;
  double product = 0.0;
  for (const Gradient& g : gradients_) {
    const float x = values[g.at + 1] - values[g.at - 1];
    const float y = values[g.at + width] - values[g.at - width];
    squares += static_cast<double>(x * x + y * y);
    product += static_cast<double>(g.x * x + g.y * y);
  }
  return squares > 0.0 ? std::clamp(product / std::sqrt(squares), -1.0, 1.0) : 0.0;
}

}  // namespace seeker::vision
