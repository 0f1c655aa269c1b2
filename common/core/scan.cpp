#include "common/core/scan.hpp"

#include <cmath>
#include <string>

namespace seeker {

RobotTime LaserScan::time_of(std::size_t beam) const {
  if (sweep == Duration::zero() || ranges_m.size() < 2) {
    return stamp;
  }
  const double share = static_cast<double>(beam) / static_cast<double>(ranges_m.size() - 1);
  return stamp + seconds((share - 0.5) * to_seconds(sweep));
}

Status validate(const LaserScan& scan) {
  if (scan.ranges_m.size() > kMaxScanBeams) {
    return fail(Errc::kTooLarge, "a laser scan of " + std::to_string(scan.ranges_m.size()) +
                                     " beams is over the limit of " + std::to_string(kMaxScanBeams));
  }
  if (!std::isfinite(scan.angle_min_rad) || !std::isfinite(scan.angle_step_rad) || scan.angle_step_rad == 0.0) {
    return fail(Errc::kInvalidArgument, "the laser scan has no valid first angle and angle step");
  }
  if (scan.sweep > kMaxSweep || scan.sweep < -kMaxSweep) {
    return fail(Errc::kInvalidArgument, "the laser scan claims to have taken longer than " +
                                            std::to_string(kMaxSweep.count()) + " s; check the laser's driver");
  }
  if (!scan.quality.empty() && scan.quality.size() != scan.ranges_m.size()) {
    return fail(Errc::kInvalidArgument, "the laser scan has " + std::to_string(scan.quality.size()) +
                                            " quality values for " + std::to_string(scan.ranges_m.size()) + " beams");
  }
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (std::isnan(scan.ranges_m[i]) || scan.ranges_m[i] < 0.0F) {
      return fail(
          Errc::kInvalidArgument,
          "beam " + std::to_string(i) + " of the laser scan is negative or not a number; check the laser's driver");
    }
  }
  return {};
}

std::vector<Point2> points_in_base(const LaserScan& scan) {
  std::vector<Point2> points;
  points.reserve(scan.ranges_m.size());
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double range = scan.ranges_m[i];
    if (std::isfinite(range) && range >= scan.range_min_m && range <= scan.range_max_m) {
      const double angle = scan.angle_rad(i);
      points.push_back(scan.base_T_laser * Point2(range * std::cos(angle), range * std::sin(angle)));
    }
  }
  return points;
}

Status validate(const SonarScan& scan) {
  for (std::size_t i = 0; i < scan.readings.size(); ++i) {
    if (std::isnan(scan.readings[i].range_m) || scan.readings[i].range_m < 0.0F) {
      return fail(Errc::kInvalidArgument,
                  "sonar " + std::to_string(i) + " is negative or not a number; check the sonar board and its cable");
    }
  }
  return {};
}

double range_on_line_m(const Point2& a, const Point2& b, double bearing_rad) {
  const Point2 along = b - a;
  const Point2 ray(std::cos(bearing_rad), std::sin(bearing_rad));
  return (a.x() * along.y() - a.y() * along.x()) / (ray.x() * along.y() - ray.y() * along.x());
}

}  // namespace seeker
