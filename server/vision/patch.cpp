#include "server/vision/patch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <opencv2/imgproc.hpp>

namespace seeker::vision {
namespace {

constexpr int kMaxLevels = 6;
constexpr int kMinLevelSide_px = 8;
/// Half sizes of plain discs and boxes, and places of plain edges, relative to half the patch.
constexpr std::array<double, 5> kPlainRadii = {0.4, 0.55, 0.7, 0.85, 1.0};
constexpr std::array<double, 5> kPlainEdges = {-0.6, -0.3, 0.0, 0.3, 0.6};
/// A target that correlates this well with a plain shape is that shape.
constexpr float kSameShape = 0.97F;

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
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      mask_.push_back(static_cast<float>(small_mask.at<std::uint8_t>(row, column)));
      centred_.push_back(scaled.at<float>(row, column));
    }
  }
  if (!centre_and_scale(centred_)) {
    std::fill(centred_.begin(), centred_.end(), 0.0F);
  }
  prepare_gradients(scaled, small_mask);
  prepare_plain_shapes();
}

bool TemplatePatch::centre_and_scale(std::vector<float>& values) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum += static_cast<double>(values[i] * mask_[i]);
  }
  const double mean = mask_count_ > 0.0 ? sum / mask_count_ : 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = (values[i] - static_cast<float>(mean)) * mask_[i];
    squares += static_cast<double>(values[i] * values[i]);
  }
  if (squares <= 0.0) {
    return false;
  }
  const auto norm = static_cast<float>(1.0 / std::sqrt(squares));
  std::transform(values.begin(), values.end(), values.begin(), [norm](float v) { return v * norm; });
  return true;
}

void TemplatePatch::prepare_plain_shapes() {
  const auto add = [this](const auto& inside) {
    std::vector<float> shape;
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        shape.push_back(inside((2.0 * column + 1.0) / columns_ - 1.0, (2.0 * row + 1.0) / rows_ - 1.0) ? 1.0F : 0.0F);
      }
    }
    if (!centre_and_scale(shape)) {
      return;
    }
    const float alike = std::inner_product(shape.begin(), shape.end(), centred_.begin(), 0.0F);
    if (std::abs(alike) < kSameShape) {
      plain_shapes_.push_back(std::move(shape));
    }
  };
  for (const double r : kPlainRadii) {
    add([r](double x, double y) { return x * x + y * y < r * r; });
    add([r](double x, double y) { return std::abs(x) < r && std::abs(y) < r; });
  }
  for (const double at : kPlainEdges) {
    add([at](double x, double) { return x < at; });
    add([at](double, double y) { return y < at; });
  }
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

double TemplatePatch::spread(const std::vector<float>& values) const {
  float sum = 0.0F;
  float squares = 0.0F;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float masked = values[i] * mask_[i];
    sum += masked;
    squares += masked * values[i];
  }
  return mask_count_ > 0.0 ? squares - static_cast<double>(sum) * sum / mask_count_ : 0.0;
}

double TemplatePatch::ncc(const std::vector<float>& values, double min_contrast) const {
  const double spread_now = spread(values);
  if (spread_now < min_contrast * min_contrast * mask_count_ || spread_now <= 0.0) {
    return 0.0;
  }
  const float product = std::inner_product(values.begin(), values.end(), centred_.begin(), 0.0F);
  return std::clamp(product / std::sqrt(spread_now), -1.0, 1.0);
}

double TemplatePatch::plain_ncc(const std::vector<float>& values) const {
  const double spread_now = spread(values);
  float best = 0.0F;
  for (const std::vector<float>& shape : plain_shapes_) {
    best = std::max(best, std::abs(std::inner_product(values.begin(), values.end(), shape.begin(), 0.0F)));
  }
  return spread_now > 0.0 ? std::min(1.0, best / std::sqrt(spread_now)) : 0.0;
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
