/// \file
/// How much of each pixel a shape covers: shapes are collected here and laid over the image once, so that
/// overlapping pieces of a translucent line do not darken each other.
#pragma once

#include <vector>

#include "common/core/image.hpp"
#include "common/core/pose2.hpp"
#include "common/image/colour.hpp"

namespace seeker::image {

class Coverage {
 public:
  /// Covers the part of the image in [low, high] (pixels, any values).
  Coverage(const Image& image, const Point2& low, const Point2& high);

  /// A line with round ends.
  void add_capsule(const Point2& a, const Point2& b, double radius_px);
  /// Even-odd filled polygon, exact along the rows and four samples a row across.
  void add_polygon(const std::vector<Point2>& corners);
  void blend_onto(Image& image, Colour colour, double alpha) const;

 private:
  [[nodiscard]] bool empty() const { return width_ <= 0 || height_ <= 0; }
  void add_span(int row, double from_px, double to_px, double weight);

  int left_ = 0;
  int top_ = 0;
  int width_ = 0;
  int height_ = 0;
  std::vector<float> share_;  ///< row-major, 0..1
};

}  // namespace seeker::image
