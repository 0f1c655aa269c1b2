/// \file
/// A small SVG writer: the shapes of maps and figures, in user units with y downwards.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "common/core/pose2.hpp"
#include "common/image/canvas.hpp"

namespace seeker::image {

/// Collects shapes; str() is the whole document. Points that are not finite are left out.
class Svg {
 public:
  /// The visible rectangle; `background` fills it.
  Svg(double width, double height, Colour background = kWhite);

  void line(const Point2& a, const Point2& b, const Stroke& stroke);
  void polyline(std::span<const Point2> points, const Stroke& stroke);
  /// Filled, with an outline when the stroke has a width.
  void polygon(std::span<const Point2> corners, Colour fill, double fill_alpha, const Stroke& stroke);
  void circle(const Point2& centre, double radius, Colour fill, double fill_alpha, const Stroke& stroke);
  void rect(const Rect& rect, Colour fill, double fill_alpha, const Stroke& stroke);
  /// Escapes what XML reserves. `size` is the height of capitals, as on a Canvas.
  void text(const Point2& at, std::string_view text, const TextStyle& style);

  [[nodiscard]] std::string str() const;

 private:
  std::string body_;
  double width_;
  double height_;
};

}  // namespace seeker::image
