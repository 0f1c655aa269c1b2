#include "common/image/canvas.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/angle.hpp"
#include "common/image/coverage.hpp"

namespace seeker::image {
namespace {

/// Longer lines are drawn without dashes: their ends are far outside of any image.
constexpr double kMaxDashedLength_px = 1e5;

std::vector<double> dash_pattern(LineStyle style, double width_px) {
  const double unit = std::max(1.0, width_px);
  switch (style) {
    case LineStyle::kSolid: return {};
    case LineStyle::kDashed: return {4.0 * unit, 3.5 * unit};
    case LineStyle::kDashDot: return {5.0 * unit, 3.0 * unit, 0.1 * unit, 3.0 * unit};
    case LineStyle::kDotted: return {0.1 * unit, 2.5 * unit};
  }
  return {};
}

/// Walks along the line and adds the drawn pieces of the pattern.
void add_dashes(Coverage& coverage, std::span<const Point2> points, const std::vector<double>& pattern,
                double radius_px) {
  std::size_t piece = 0;
  double left = pattern[0];
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double length = (points[i + 1] - points[i]).norm();
    if (!(length > 0.0)) {
      continue;
    }
    const Point2 direction = (points[i + 1] - points[i]) / length;
    double done = 0.0;
    while (done < length) {
      const double step = std::min(left, length - done);
      if (piece % 2 == 0) {
        coverage.add_capsule(points[i] + done * direction, points[i] + (done + step) * direction, radius_px);
      }
      done += step;
      left -= step;
      if (left <= 0.0) {
        piece = (piece + 1) % pattern.size();
        left = pattern[piece];
      }
    }
  }
}

double length_px(std::span<const Point2> points) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    sum += (points[i + 1] - points[i]).norm();
  }
  return sum;
}

std::vector<Point2> finite_points(std::span<const Point2> points) {
  std::vector<Point2> finite;
  std::copy_if(points.begin(), points.end(), std::back_inserter(finite), [](const Point2& p) { return p.allFinite(); });
  return finite;
}

Coverage coverage_of(const Image& image, std::span<const Point2> points, double margin_px) {
  Point2 low = points.front();
  Point2 high = points.front();
  for (const Point2& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return {image, low - Point2::Constant(margin_px), high + Point2::Constant(margin_px)};
}

}  // namespace

Canvas::Canvas(int width_px, int height_px, Colour background) : image_(width_px, height_px, 3) {
  fill_rect({0.0, 0.0, static_cast<double>(width_px), static_cast<double>(height_px)}, background);
}

Canvas::Canvas(const Image& picture) : image_(picture.width_px(), picture.height_px(), 3) {
  if (picture.channels() == 3) {
    image_ = picture;
    return;
  }
  for (std::size_t i = 0; i < image_.data().size(); ++i) {
    image_.data()[i] = picture.data()[i / 3];
  }
}

void Canvas::set_pixel(int u, int v, Colour colour) { blend(u, v, colour, 1.0); }

Colour Canvas::pixel(int u, int v) const {
  const std::uint8_t* p = image_.at(u, v);
  return {p[0], p[1], p[2]};
}

void Canvas::blend(int u, int v, Colour colour, double alpha) {
  if (u < 0 || v < 0 || u >= image_.width_px() || v >= image_.height_px()) {
    return;
  }
  const Colour mixed = mix(pixel(u, v), colour, alpha);
  std::uint8_t* p = image_.at(u, v);
  p[0] = mixed.red;
  p[1] = mixed.green;
  p[2] = mixed.blue;
}

void Canvas::fill_rect(const Rect& rect, Colour colour, double alpha) {
  const double right = rect.x_px + rect.width_px;
  const double bottom = rect.y_px + rect.height_px;
  fill_polygon(std::array<Point2, 4>{Point2(rect.x_px, rect.y_px), Point2(right, rect.y_px), Point2(right, bottom),
                                     Point2(rect.x_px, bottom)},
               colour, alpha);
}

void Canvas::rect(const Rect& rect, const Stroke& stroke) {
  const double right = rect.x_px + rect.width_px;
  const double bottom = rect.y_px + rect.height_px;
  polygon(std::array<Point2, 4>{Point2(rect.x_px, rect.y_px), Point2(right, rect.y_px), Point2(right, bottom),
                                Point2(rect.x_px, bottom)},
          stroke);
}

void Canvas::line(const Point2& a, const Point2& b, const Stroke& stroke) {
  polyline(std::array<Point2, 2>{a, b}, stroke);
}

void Canvas::polyline(std::span<const Point2> points, const Stroke& stroke) {
  const std::vector<Point2> finite = finite_points(points);
  if (finite.empty()) {
    return;
  }
  const double radius = stroke.width_px / 2.0;
  Coverage coverage = coverage_of(image_, finite, radius + 1.0);
  const std::vector<double> pattern = dash_pattern(stroke.style, stroke.width_px);
  if (!pattern.empty() && length_px(finite) < kMaxDashedLength_px) {
    add_dashes(coverage, finite, pattern, radius);
  } else {
    for (std::size_t i = 0; i < std::max<std::size_t>(1, finite.size() - 1); ++i) {
      coverage.add_capsule(finite[i], finite[std::min(i + 1, finite.size() - 1)], radius);
    }
  }
  coverage.blend_onto(image_, stroke.colour, stroke.alpha);
}

void Canvas::polygon(std::span<const Point2> corners, const Stroke& stroke) {
  std::vector<Point2> closed(corners.begin(), corners.end());
  if (!closed.empty()) {
    closed.push_back(closed.front());
  }
  polyline(closed, stroke);
}

void Canvas::fill_polygon(std::span<const Point2> corners, Colour colour, double alpha) {
  const std::vector<Point2> finite = finite_points(corners);
  if (finite.size() < 3) {
    return;
  }
  Coverage coverage = coverage_of(image_, finite, 1.0);
  coverage.add_polygon(finite);
  coverage.blend_onto(image_, colour, alpha);
}

void Canvas::circle(const Point2& centre, double radius_px, const Stroke& stroke) {
  ellipse(centre, Matrix2::Identity(), radius_px, stroke);
}

void Canvas::fill_circle(const Point2& centre, double radius_px, Colour colour, double alpha) {
  polyline(std::array<Point2, 1>{centre}, {colour, 2.0 * radius_px, LineStyle::kSolid, alpha});
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

void Canvas::ellipse(const Point2& centre, const Matrix2& covariance_px2, double sigmas, const Stroke& stroke) {
  if (!centre.allFinite() || !covariance_px2.allFinite()) {
    return;
  }
  // Eigenvalues and axes of a symmetric 2x2 matrix in closed form.
  const double mean = (covariance_px2(0, 0) + covariance_px2(1, 1)) / 2.0;
  const double half = (covariance_px2(0, 0) - covariance_px2(1, 1)) / 2.0;
  const double spread = std::hypot(half, covariance_px2(0, 1));
  const double axis_rad = 0.5 * std::atan2(covariance_px2(0, 1), half);
  const double major_px = sigmas * std::sqrt(std::max(0.0, mean + spread));
  const double minor_px = sigmas * std::sqrt(std::max(0.0, mean - spread));
  const Point2 major = major_px * Point2(std::cos(axis_rad), std::sin(axis_rad));
  const Point2 minor = minor_px * Point2(-std::sin(axis_rad), std::cos(axis_rad));
  constexpr int kCorners = 72;
  std::vector<Point2> corners;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = kTwoPi * i / kCorners;
    corners.push_back(centre + std::cos(angle) * major + std::sin(angle) * minor);
  }
  polygon(corners, stroke);
}

}  // namespace seeker::image
