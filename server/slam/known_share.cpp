#include "server/slam/known_share.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/angle.hpp"

namespace seeker::slam {
namespace {

/// Distance of the places of the floor along a beam, and of the last of them from the surface that the beam meets.
constexpr double kFloorStep_m = 0.5;
constexpr double kFloorMargin_m = 0.4;

bool shows_surface(const PlacedMap& map, const OrientedPoint& seen_map) {
  const double normal_rad = std::atan2(seen_map.normal.y(), seen_map.normal.x());
  const LikelihoodPyramid& pyramid = map.place->pyramid();
  const int direction = pyramid.direction_of(wrap_angle(normal_rad + map.node_T_map.theta_rad));
  return pyramid.value(map.node_T_map * seen_map.p, direction) > 0;
}

}  // namespace

std::vector<Point2> passed_floor(const LaserScan& scan, double range_m) {
  std::vector<Point2> floor_base;
  for (std::size_t k = 0; k < scan.ranges_m.size(); ++k) {
    const double measured_m = scan.ranges_m[k];
    if (std::isnan(measured_m)) {
      continue;
    }
    const double end_m = std::min(measured_m - kFloorMargin_m, range_m);
    const double angle_rad = scan.angle_rad(k);
    for (double along_m = kFloorStep_m; along_m < end_m; along_m += kFloorStep_m) {
      floor_base.push_back(scan.base_T_laser * Point2(along_m * std::cos(angle_rad), along_m * std::sin(angle_rad)));
    }
  }
  return floor_base;
}

ScanView transform(const Pose2& a_T_b, const ScanView& view_b) {
  ScanView view_a{transform(a_T_b, view_b.surfaces), view_b.floor};
  for (Point2& p : view_a.floor) {
    p = a_T_b * p;
  }
  return view_a;
}

double known_share(const ScanView& view_map, const std::vector<PlacedMap>& maps) {
  const auto surfaces =
      std::count_if(view_map.surfaces.points.begin(), view_map.surfaces.points.end(), [&](const OrientedPoint& seen) {
        return std::any_of(maps.begin(), maps.end(), [&](const PlacedMap& map) { return shows_surface(map, seen); });
      });
  const auto floor = std::count_if(view_map.floor.begin(), view_map.floor.end(), [&](const Point2& p_map) {
    return std::any_of(maps.begin(), maps.end(),
                       [&](const PlacedMap& map) { return map.place->free_space().is_passed(map.node_T_map * p_map); });
  });
  const std::size_t all = view_map.surfaces.points.size() + view_map.floor.size();
  return all > 0 ? static_cast<double>(surfaces + floor) / static_cast<double>(all) : 0.0;
}

}  // namespace seeker::slam
