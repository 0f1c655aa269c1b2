#include "common/core/scan_motion.hpp"

#include <cmath>
#include <vector>

#include "common/core/angle.hpp"

namespace seeker {
namespace {

/// Places moved beams into the grid of a scan; for each cell the nearest one wins.
class BeamGrid {
 public:
  explicit BeamGrid(const LaserScan& scan) : result_(scan), distance_(scan.ranges_m.size(), 1.0) {
    const double around_rad = std::abs(scan.angle_step_rad) * static_cast<double>(scan.ranges_m.size());
    closed_ = std::abs(around_rad - kTwoPi) < 0.5 * std::abs(scan.angle_step_rad);
    result_.sweep = Duration::zero();
    result_.ranges_m.assign(scan.ranges_m.size(), kNoReturn);
    result_.quality.assign(scan.quality.size(), 0);
  }

  /// `place`: the beam's direction in steps from beam 0.
  void put(double place, float range_m, std::uint8_t quality) {
    const double below = std::floor(place);
    put_into(below, place - below, range_m, quality);
    put_into(below + 1.0, below + 1.0 - place, range_m, quality);
  }

  [[nodiscard]] const LaserScan& result() const { return result_; }

 private:
  void put_into(double cell, double distance, float range_m, std::uint8_t quality) {
    const auto cells = static_cast<double>(distance_.size());
    const double index = closed_ ? cell - cells * std::floor(cell / cells) : cell;
    if (!(index >= 0.0 && index < cells)) {
      return;
    }
    const auto at = static_cast<std::size_t>(index);
    if (distance < distance_[at]) {
      distance_[at] = distance;
      result_.ranges_m[at] = range_m;
      if (!result_.quality.empty()) {
        result_.quality[at] = quality;
      }
    }
  }

  LaserScan result_;
  std::vector<double> distance_;  ///< of each cell's beam from its middle, in steps
  bool closed_ = false;           ///< the last beam is a neighbour of the first
};

}  // namespace

LaserScan corrected_for_motion(const LaserScan& scan, const std::function<Pose2(RobotTime)>& odom_T_base_at) {
  if (scan.sweep == Duration::zero()) {
    return scan;
  }
  BeamGrid grid(scan);
  const Pose2 laser_T_odom = inverse(odom_T_base_at(scan.stamp) * scan.base_T_laser);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const Pose2 laser_T_then = laser_T_odom * odom_T_base_at(scan.time_of(i)) * scan.base_T_laser;
    const double angle_rad = scan.angle_rad(i);
    double bearing_rad = angle_rad + laser_T_then.theta_rad;
    float range_m = scan.ranges_m[i];
    if (std::isfinite(range_m)) {
      const Point2 end = laser_T_then * Point2(range_m * std::cos(angle_rad), range_m * std::sin(angle_rad));
      bearing_rad = std::atan2(end.y(), end.x());
      range_m = static_cast<float>(end.norm());
    }
    const double moved_steps = wrap_angle(bearing_rad - angle_rad) / scan.angle_step_rad;
    grid.put(static_cast<double>(i) + moved_steps, range_m, scan.quality.empty() ? std::uint8_t{0} : scan.quality[i]);
  }
  return grid.result();
}

}  // namespace seeker
