// Shapes that are made of a canvas's lines, areas and curves.

#include <array>

#include "common/image/canvas.hpp"

namespace seeker::image {
namespace {

std::array<Point2, 4> corners_of(const Rect& rect) {
  const double right = rect.x_px + rect.width_px;
  const double bottom = rect.y_px + rect.height_px;
  return {Point2(rect.x_px, rect.y_px), Point2(right, rect.y_px), Point2(right, bottom), Point2(rect.x_px, bottom)};
}

}  // namespace

void Canvas::fill_rect(const Rect& rect, Colour colour, double alpha) { fill_polygon(corners_of(rect), colour, alpha); }

void Canvas::rect(const Rect& rect, const Stroke& stroke) { polygon(corners_of(rect), stroke); }

void Canvas::line(const Point2& a, const Point2& b, const Stroke& stroke) {
  polyline(std::array<Point2, 2>{a, b}, stroke);
}

void Canvas::circle(const Point2& centre, double radius_px, const Stroke& stroke) {
  ellipse(centre, Matrix2::Identity(), radius_px, stroke);
}

void Canvas::arrow(const Point2& from, const Point2& to, const Stroke& stroke, double head_px) {
  const double length = (to - from).norm();
  if (!(length > 0.0)) {
    return;
  }
  const Point2 forward = (to - from) / length;
  const Point2 side(-forward.y(), forward.x());
  const Point2 neck = to - head_px * forward;
  constexpr double kHalfWidth = 0.45;
  line(from, neck, stroke);
  fill_polygon(std::array<Point2, 3>{to, neck + kHalfWidth * head_px * side, neck - kHalfWidth * head_px * side},
               stroke.colour, stroke.alpha);
}

}  // namespace seeker::image
