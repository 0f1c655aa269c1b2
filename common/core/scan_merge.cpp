#include "common/core/scan_merge.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "common/core/angle.hpp"
#include "common/core/assert.hpp"
#include "common/core/scan_motion.hpp"

namespace seeker {
namespace {

std::uint8_t quality_of(const LaserScan& scan, std::size_t beam) {
  return scan.quality.empty() ? std::uint8_t{1} : scan.quality[beam];
}

/// A return as seen from the base.
struct Return {
  Point2 p_base;
  double bearing_rad = 0.0;
  float scanner_range_m = 0.0F;
  std::uint8_t quality = 0;
};

/// The circle of beams around the base; in each direction the nearest return wins.
class Circle {
 public:
  Circle(RobotTime stamp, const ScanMergeParams& params) : params_(params) {
    const double wanted = std::round(kTwoPi / params.angle_step_rad);
    const auto beams = static_cast<std::size_t>(std::clamp(wanted, 1.0, static_cast<double>(kMaxScanBeams)));
    scan_.stamp = stamp;
    scan_.angle_min_rad = -kPi;
    scan_.angle_step_rad = kTwoPi / static_cast<double>(beams);
    scan_.ranges_m.assign(beams, kNoReturn);
    scan_.quality.assign(beams, 0);
  }

  void widen_reach(double range_max_m) { scan_.range_max_m = std::max(scan_.range_max_m, range_max_m); }
  void add(const Return& seen) { put(beam_of(seen.bearing_rad), seen.p_base.norm(), seen.quality); }
  /// Nothing came back from this direction.
  void add_nothing(double bearing_rad, std::uint8_t quality) {
    const std::size_t beam = index(beam_of(bearing_rad));
    if (!std::isfinite(scan_.ranges_m[beam])) {
      scan_.quality[beam] = std::max(scan_.quality[beam], quality);
    }
  }
  /// Fills the directions between two neighbouring returns of one scanner where both lie on one surface.
  void join(const Return& a, const Return& b);

  [[nodiscard]] const LaserScan& scan() const { return scan_; }

 private:
  [[nodiscard]] std::int64_t beam_of(double bearing_rad) const {
    return std::llround((bearing_rad - scan_.angle_min_rad) / scan_.angle_step_rad);
  }
  [[nodiscard]] std::size_t index(std::int64_t beam) const {
    const auto beams = static_cast<std::int64_t>(scan_.ranges_m.size());
    return static_cast<std::size_t>(((beam % beams) + beams) % beams);
  }
  void put(std::int64_t beam, double range_m, std::uint8_t quality) {
    const std::size_t at = index(beam);
    const auto range = static_cast<float>(range_m);
    if (range < scan_.ranges_m[at]) {
      scan_.ranges_m[at] = range;
      scan_.quality[at] = quality;
    }
  }

  ScanMergeParams params_;
  LaserScan scan_;
};

void Circle::join(const Return& a, const Return& b) {
  const double gap_rad = wrap_angle(b.bearing_rad - a.bearing_rad);
  const float nearer_m = std::min(a.scanner_range_m, b.scanner_range_m);
  const double step_m = std::abs(a.scanner_range_m - b.scanner_range_m);
  if (std::abs(gap_rad) > params_.largest_gap_rad || step_m > params_.surface_step * static_cast<double>(nearer_m)) {
    return;
  }
  const Return& from = gap_rad > 0.0 ? a : b;
  const std::int64_t first = beam_of(from.bearing_rad);
  const std::int64_t last = beam_of(from.bearing_rad + std::abs(gap_rad));
  for (std::int64_t beam = first + 1; beam < last; ++beam) {
    const double bearing_rad = scan_.angle_min_rad + static_cast<double>(beam) * scan_.angle_step_rad;
    const double range_m = range_on_line_m(a.p_base, b.p_base, bearing_rad);
    if (std::isfinite(range_m) && range_m > 0.0) {
      put(beam, range_m, std::min(a.quality, b.quality));
    }
  }
}

void add_scan(const LaserScan& scan, const Pose2& base_T_then, Circle& circle) {
  const Pose2 base_T_laser = base_T_then * scan.base_T_laser;
  circle.widen_reach(scan.range_max_m + base_T_laser.translation().norm());
  std::optional<Return> last;
  for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
    const float range_m = scan.ranges_m[beam];
    const std::uint8_t quality = quality_of(scan, beam);
    const double angle_rad = scan.angle_rad(beam);
    const bool is_return = std::isfinite(range_m) && range_m >= scan.range_min_m && range_m <= scan.range_max_m;
    if (quality == 0 || !is_return) {
      last.reset();
      if (quality > 0 && !std::isfinite(range_m)) {
        circle.add_nothing(base_T_laser.theta_rad + angle_rad, quality);
      }
      continue;
    }
    const Point2 p_base = base_T_laser * Point2(range_m * std::cos(angle_rad), range_m * std::sin(angle_rad));
    const Return seen{p_base, std::atan2(p_base.y(), p_base.x()), range_m, quality};
    circle.add(seen);
    if (last) {
      circle.join(*last, seen);
    }
    last = seen;
  }
}

}  // namespace

LaserScan merged_scan(std::span<const LaserScan> scans, const std::function<Pose2(RobotTime)>& odom_T_base_at,
                      const ScanMergeParams& params) {
  SEEKER_ASSERT(!scans.empty());
  const RobotTime stamp = scans.front().stamp;
  const Pose2 base_T_odom = inverse(odom_T_base_at(stamp));
  Circle circle(stamp, params);
  for (const LaserScan& scan : scans) {
    add_scan(corrected_for_motion(scan, odom_T_base_at), base_T_odom * odom_T_base_at(scan.stamp), circle);
  }
  return circle.scan();
}

}  // namespace seeker
