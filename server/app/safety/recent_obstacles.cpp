#include "server/app/safety/recent_obstacles.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/angle.hpp"

namespace seeker::app {
namespace {

/// Half the thickness of a table's leg: what is nearer to each other need not be told apart.
constexpr double kCell_m = 0.05;

/// Whether the scan has a beam in the direction of the point, and reaches as far.
bool looks_at(const LaserScan& scan, const Point2& p_base) {
  if (scan.ranges_m.empty() || (p_base - scan.base_T_laser.translation()).norm() > scan.range_max_m) {
    return false;
  }
  const double first_rad = std::min(scan.angle_rad(0), scan.angle_rad(scan.ranges_m.size() - 1));
  const double last_rad = std::max(scan.angle_rad(0), scan.angle_rad(scan.ranges_m.size() - 1));
  const double middle_rad = (first_rad + last_rad) / 2.0;
  const double off_rad = std::abs(wrap_angle(bearing_to(scan.base_T_laser, p_base) - middle_rad));
  return off_rad <= (last_rad - first_rad) / 2.0;
}

}  // namespace

void RecentObstacles::see(const LaserScan& scan, const Pose2& odom_T_base) {
  const Pose2 base_T_odom = inverse(odom_T_base);
  std::erase_if(cells_, [&](const auto& cell) {
    const Point2 p_base = base_T_odom * cell.second.p_odom;
    return cell.second.stamp + kKept < scan.stamp || p_base.norm() > kReach_m || looks_at(scan, p_base);
  });
  for (const Point2& p_base : points_in_base(scan)) {
    if (p_base.norm() <= kReach_m) {
      const Point2 p_odom = odom_T_base * p_base;
      const Cell cell{std::llround(p_odom.x() / kCell_m), std::llround(p_odom.y() / kCell_m)};
      cells_.insert_or_assign(cell, Seen{p_odom, scan.stamp});
    }
  }
}

std::vector<Point2> RecentObstacles::in_base(const Pose2& odom_T_base, RobotTime now) const {
  const Pose2 base_T_odom = inverse(odom_T_base);
  std::vector<Point2> points;
  for (const auto& [cell, seen] : cells_) {
    if (now - seen.stamp <= kKept) {
      points.push_back(base_T_odom * seen.p_odom);
    }
  }
  return points;
}

}  // namespace seeker::app
