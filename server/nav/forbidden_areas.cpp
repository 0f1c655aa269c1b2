#include "server/nav/forbidden_areas.hpp"

#include <algorithm>
#include <cmath>

namespace seeker::nav {
namespace {

/// How far beyond a border a point is tested for being forbidden.
constexpr double kBeyondBorder_m = 1e-4;

/// Distance along the ray to the edge a-b, if it is hit.
std::optional<double> ray_to_edge(const Point2& from, const Point2& direction, const Point2& a, const Point2& b) {
  const Point2 edge = b - a;
  const double cross = direction.x() * edge.y() - direction.y() * edge.x();
  constexpr double kParallel = 1e-12;
  if (std::abs(cross) < kParallel) {
    return std::nullopt;
  }
  const Point2 to_a = a - from;
  const double along_ray = (to_a.x() * edge.y() - to_a.y() * edge.x()) / cross;
  const double along_edge = (to_a.x() * direction.y() - to_a.y() * direction.x()) / cross;
  if (along_ray < 0.0 || along_edge < 0.0 || along_edge > 1.0) {
    return std::nullopt;
  }
  return along_ray;
}

void collect_hits(const Polygon& polygon, const Point2& from, const Point2& direction, std::vector<double>& hits) {
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    if (const auto hit = ray_to_edge(from, direction, polygon[k], polygon[(k + 1) % polygon.size()])) {
      hits.push_back(*hit);
    }
  }
}

}  // namespace

bool ForbiddenAreas::outside_bound(const Point2& p_map) const { return bound && !contains(*bound, p_map); }

bool ForbiddenAreas::in_keep_out(const Point2& p_map) const {
  return std::any_of(keep_out.begin(), keep_out.end(), [&](const Polygon& area) { return contains(area, p_map); });
}

std::optional<double> distance_to_forbidden(const ForbiddenAreas& areas, const Point2& from_map, double direction_rad,
                                            double max_m) {
  const Point2 direction(std::cos(direction_rad), std::sin(direction_rad));
  std::vector<double> hits;
  if (areas.bound) {
    collect_hits(*areas.bound, from_map, direction, hits);
  }
  for (const Polygon& area : areas.keep_out) {
    collect_hits(area, from_map, direction, hits);
  }
  std::sort(hits.begin(), hits.end());
  for (const double hit : hits) {
    if (hit > max_m) {
      break;
    }
    if (!areas.allows(from_map + (hit + kBeyondBorder_m) * direction)) {
      return hit;
    }
  }
  return std::nullopt;
}

}  // namespace seeker::nav
