#include "server/slam/seen_through.hpp"

#include <cmath>
#include <optional>

#include "common/core/angle.hpp"

namespace seeker::slam {
namespace {

/// The range along the beam that points there; nothing outside the field of view or where it has not come back.
std::optional<double> range_towards(const LaserScan& scan, double bearing_rad) {
  const double from_first_rad =
      scan.angle_step_rad > 0.0 ? bearing_rad - scan.angle_min_rad : scan.angle_min_rad - bearing_rad;
  const double rotated_rad = std::fmod(std::fmod(from_first_rad, kTwoPi) + kTwoPi, kTwoPi);
  const auto beam = static_cast<std::size_t>(std::lround(rotated_rad / std::abs(scan.angle_step_rad)));
  if (beam >= scan.ranges_m.size() || !std::isfinite(scan.ranges_m[beam])) {
    return std::nullopt;
  }
  return scan.ranges_m[beam];
}

}  // namespace

double seen_through(const ReferenceCloud& reference, const LaserScan& scan, const Pose2& map_T_base,
                    const SeenThroughParams& params) {
  const Pose2 map_T_laser = map_T_base * scan.base_T_laser;
  const Pose2 laser_T_map = inverse(map_T_laser);
  const double least_cosine = std::sin(params.grazing_rad);
  int shown = 0;
  int through = 0;
  for (const OrientedPoint& point : reference.points()) {
    const Point2 to_laser = map_T_laser.translation() - point.p;
    const double distance_m = to_laser.norm();
    if (point.normal.dot(to_laser) < least_cosine * distance_m) {
      continue;
    }
    const Point2 p_laser = laser_T_map * point.p;
    const std::optional<double> range_m = range_towards(scan, std::atan2(p_laser.y(), p_laser.x()));
    if (!range_m || *range_m < distance_m - params.margin_m) {
      continue;
    }
    ++shown;
    through += *range_m > distance_m + params.margin_m ? 1 : 0;
  }
  return shown > 0 ? static_cast<double>(through) / shown : 0.0;
}

}  // namespace seeker::slam
