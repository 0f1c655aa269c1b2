#include "common/image/coverage.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/polygon.hpp"

namespace seeker::image {
namespace {

/// A coordinate as an index that fits the image, whatever its value was.
int index_in(double value, int low, int high) {
  return static_cast<int>(std::clamp(value, static_cast<double>(low), static_cast<double>(high)));
}

constexpr int kRowSamples = 4;

}  // namespace

Coverage::Coverage(const Image& image, const Point2& low, const Point2& high) {
  left_ = index_in(std::floor(low.x()), 0, image.width_px());
  top_ = index_in(std::floor(low.y()), 0, image.height_px());
  width_ = index_in(std::ceil(high.x()), 0, image.width_px()) - left_;
  height_ = index_in(std::ceil(high.y()), 0, image.height_px()) - top_;
  if (!empty()) {
    share_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0.0F);
  }
}

void Coverage::add_capsule(const Point2& a, const Point2& b, double radius_px) {
  if (empty() || !a.allFinite() || !b.allFinite()) {
    return;
  }
  const double reach = radius_px + 1.0;
  const int u0 = index_in(std::floor(std::min(a.x(), b.x()) - reach), left_, left_ + width_);
  const int u1 = index_in(std::ceil(std::max(a.x(), b.x()) + reach), left_, left_ + width_);
  const int v0 = index_in(std::floor(std::min(a.y(), b.y()) - reach), top_, top_ + height_);
  const int v1 = index_in(std::ceil(std::max(a.y(), b.y()) + reach), top_, top_ + height_);
  // A line thinner than a pixel keeps its width and loses strength.
  const double strength = std::min(1.0, 2.0 * radius_px);
  const double radius = std::max(radius_px, 0.5);
  for (int v = v0; v < v1; ++v) {
    float* row = share_.data() + static_cast<std::ptrdiff_t>(v - top_) * width_ - left_;
    for (int u = u0; u < u1; ++u) {
      const double d = distance_to_segment_m(a, b, Point2(u + 0.5, v + 0.5));
      const double share = strength * std::clamp(radius + 0.5 - d, 0.0, 1.0);
      row[u] = std::max(row[u], static_cast<float>(share));
    }
  }
}

void Coverage::add_span(int row, double from_px, double to_px, double weight) {
  const double from = std::max(from_px, static_cast<double>(left_));
  const double to = std::min(to_px, static_cast<double>(left_ + width_));
  if (!(from < to)) {
    return;
  }
  float* cells = share_.data() + static_cast<std::ptrdiff_t>(row) * width_ - left_;
  const int last = std::min(static_cast<int>(std::floor(to)), left_ + width_ - 1);
  for (int u = static_cast<int>(std::floor(from)); u <= last; ++u) {
    const double share = std::min(to, u + 1.0) - std::max(from, static_cast<double>(u));
    cells[u] = std::min(1.0F, cells[u] + static_cast<float>(std::max(0.0, share) * weight));
  }
}

void Coverage::add_polygon(const std::vector<Point2>& corners) {
  if (empty() || corners.size() < 3) {
    return;
  }
  std::vector<double> crossings;
  for (int sample = 0; sample < height_ * kRowSamples; ++sample) {
    const double y = top_ + (sample + 0.5) / kRowSamples;
    crossings.clear();
    for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
      const Point2& a = corners[i];
      const Point2& b = corners[j];
      if ((a.y() > y) != (b.y() > y)) {
        crossings.push_back(a.x() + (y - a.y()) * (b.x() - a.x()) / (b.y() - a.y()));
      }
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      add_span(sample / kRowSamples, crossings[i], crossings[i + 1], 1.0 / kRowSamples);
    }
  }
}

void Coverage::blend_onto(Image& image, Colour colour, double alpha) const {
  if (empty()) {
    return;
  }
  for (int v = 0; v < height_; ++v) {
    for (int u = 0; u < width_; ++u) {
      const double share =
          alpha * share_[static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u)];
      if (share <= 0.0) {
        continue;
      }
      std::uint8_t* pixel = image.at(left_ + u, top_ + v);
      const Colour mixed = mix({pixel[0], pixel[1], pixel[2]}, colour, share);
      pixel[0] = mixed.red;
      pixel[1] = mixed.green;
      pixel[2] = mixed.blue;
    }
  }
}

}  // namespace seeker::image
