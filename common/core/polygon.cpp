#include "common/core/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace seeker {
namespace {

double cross(const Point2& a, const Point2& b) { return a.x() * b.y() - a.y() * b.x(); }

double orientation(const Point2& a, const Point2& b, const Point2& c) { return cross(b - a, c - a); }

bool within_box(const Point2& a, const Point2& b, const Point2& p) {
  return p.x() >= std::min(a.x(), b.x()) && p.x() <= std::max(a.x(), b.x()) && p.y() >= std::min(a.y(), b.y()) &&
         p.y() <= std::max(a.y(), b.y());
}

}  // namespace

bool segments_intersect(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  const double o1 = orientation(a, b, c);
  const double o2 = orientation(a, b, d);
  const double o3 = orientation(c, d, a);
  const double o4 = orientation(c, d, b);
  if (((o1 > 0) != (o2 > 0)) && ((o3 > 0) != (o4 > 0)) && o1 != 0 && o2 != 0 && o3 != 0 && o4 != 0) {
    return true;
  }
  return (o1 == 0 && within_box(a, b, c)) || (o2 == 0 && within_box(a, b, d)) || (o3 == 0 && within_box(c, d, a)) ||
         (o4 == 0 && within_box(c, d, b));
}

Status validate_polygon(const Polygon& polygon) {
  const std::size_t n = polygon.size();
  if (n < 3 || n > kMaxPolygonCorners) {
    return fail(Errc::kInvalidArgument,
                "a polygon needs 3 to " + std::to_string(kMaxPolygonCorners) + " corners, got " + std::to_string(n));
  }
  for (const Point2& p : polygon) {
    if (!p.allFinite()) {
      return fail(Errc::kInvalidArgument, "a polygon corner is not a finite number");
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      const bool neighbours = j == i + 1 || (i == 0 && j == n - 1);
      if (!neighbours && segments_intersect(polygon[i], polygon[(i + 1) % n], polygon[j], polygon[(j + 1) % n])) {
        return fail(Errc::kInvalidArgument, "the polygon crosses itself: its edge " + std::to_string(i + 1) +
                                                " meets edge " + std::to_string(j + 1) +
                                                "; list the corners in order along the border");
      }
    }
  }
  constexpr double kSmallestArea_m2 = 1e-6;
  if (std::abs(signed_area_m2(polygon)) < kSmallestArea_m2) {
    return fail(Errc::kInvalidArgument, "the polygon encloses no area");
  }
  return {};
}

bool contains(const Polygon& polygon, const Point2& p) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Point2& a = polygon[i];
    const Point2& b = polygon[j];
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x()) {
      inside = !inside;
    }
  }
  return inside;
}

double signed_area_m2(const Polygon& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  }
  return twice / 2.0;
}

double distance_to_segment_m(const Point2& a, const Point2& b, const Point2& p) {
  const Point2 ab = b - a;
  const double length2 = ab.squaredNorm();
  const double t = length2 > 0.0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
  return (p - (a + t * ab)).norm();
}

double distance_to_edge_m(const Polygon& polygon, const Point2& p) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    best = std::min(best, distance_to_segment_m(polygon[i], polygon[(i + 1) % polygon.size()], p));
  }
  return best;
}

}  // namespace seeker
