#include "server/search/sectors.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/angle.hpp"

namespace seeker::search {
namespace {

constexpr double kFrontLimit_rad = deg_to_rad(20.0);
constexpr double kFlankLimit_rad = deg_to_rad(70.0);
constexpr double kSideLimit_rad = deg_to_rad(110.0);
/// Bearings of the Pioneer's front array, along which virtual walls are looked for.
constexpr std::array<double, 8> kRingBearings_deg{90.0, 50.0, 30.0, 10.0, -10.0, -30.0, -50.0, -90.0};
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

std::optional<Sector> sector_of(double bearing_rad) {
  const double bearing = wrap_angle(bearing_rad);
  const double size = std::abs(bearing);
  if (size <= kFrontLimit_rad) {
    return Sector::kFront;
  }
  if (size <= kFlankLimit_rad) {
    return bearing > 0.0 ? Sector::kLeftFront : Sector::kRightFront;
  }
  if (size <= kSideLimit_rad) {
    return bearing > 0.0 ? Sector::kLeft : Sector::kRight;
  }
  return std::nullopt;
}

Result<Sectors> fuse_sectors(const SonarScan& scan) {
  Sectors sectors;
  sectors.distance_m.fill(kMaxDistance_m);
  std::array<bool, kSectors> covered{};
  for (const SonarReading& reading : scan.readings) {
    const auto sector = sector_of(reading.base_T_sonar.theta_rad);
    if (!sector) {
      continue;
    }
    const double range = reading.range_m;
    if (std::isnan(range) || range < 0.0) {
      return fail(Errc::kInvalidArgument, "a sonar reads no valid distance; check its cable and driver");
    }
    const auto k = static_cast<std::size_t>(*sector);
    covered[k] = true;
    sectors.distance_m[k] = std::min(sectors.distance_m[k], range);
  }
  if (!std::all_of(covered.begin(), covered.end(), [](bool c) { return c; })) {
    return fail(Errc::kInvalidArgument,
                "the sonar ring leaves a sector of the local planner blind; fit the front array");
  }
  return sectors;
}

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

Sectors with_virtual_walls(Sectors sectors, const ForbiddenAreas& areas, const Pose2& map_T_base,
                           double ring_radius_m) {
  if (areas.empty()) {
    return sectors;
  }
  for (const double bearing_deg : kRingBearings_deg) {
    const double bearing = deg_to_rad(bearing_deg);
    const auto hit = distance_to_forbidden(areas, map_T_base.translation(), map_T_base.theta_rad + bearing,
                                           kMaxDistance_m + ring_radius_m);
    if (hit) {
      double& distance = sectors.distance_m[static_cast<std::size_t>(*sector_of(bearing))];
      distance = std::min(distance, std::max(0.0, *hit - ring_radius_m));
    }
  }
  return sectors;
}

}  // namespace seeker::search
