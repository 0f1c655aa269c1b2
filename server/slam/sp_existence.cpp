#include "server/slam/sp_existence.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/angle.hpp"

namespace seeker::slam {
namespace {

/// Beams from `first` on, `count` of them, in the scan's own order.
struct BeamRange {
  long first = 0;
  long count = 0;
};

/// The beams between two bearings less than half a circle apart. A scan of a full circle has a cut at some bearing.
BeamRange beams_between(const LaserScan& scan, double from_rad, double to_rad) {
  const double step = scan.angle_step_rad;
  const double begin_rad = step > 0.0 ? from_rad : to_rad;
  const double ahead_rad = wrap_angle(begin_rad - scan.angle_min_rad);
  // The first beam at or behind the bearing, counted from the scan's own first beam.
  const double turn = std::copysign(kTwoPi, step);
  const double offset = step * ahead_rad < 0.0 ? ahead_rad + turn : ahead_rad;
  return {static_cast<long>(std::ceil(offset / step)),
          static_cast<long>(std::abs(wrap_angle(to_rad - from_rad) / step))};
}

}  // namespace

Sight look_at(const SpState& state, std::size_t segment, const LaserScan& scan) {
  const SpExistenceParams& params = state.params.existence;
  const SpSegment& f = state.segments[segment];
  const Pose2 laser_T_segment = inverse(state.map_T_base * scan.base_T_laser) * f.map_T_segment;
  const double half_m = 0.5 * f.length_m - params.end_margin_m;
  const Point2 tangent(std::cos(laser_T_segment.theta_rad), std::sin(laser_T_segment.theta_rad));
  const Point2 normal(-tangent.y(), tangent.x());
  const double distance_m = normal.dot(laser_T_segment.translation());
  if (half_m <= 0.0 || distance_m <= 0.0) {
    return Sight::kNothing;  // too short, or seen from behind
  }
  const Point2 right = laser_T_segment * Point2(half_m, 0.0);
  const Point2 left = laser_T_segment * Point2(-half_m, 0.0);
  const BeamRange range = beams_between(scan, std::atan2(right.y(), right.x()), std::atan2(left.y(), left.x()));
  const auto size = static_cast<long>(scan.ranges_m.size());
  const long stride = std::max<long>(1, range.count / std::max(params.beams, 1));
  const Index at = state.records[segment].at;
  const double sigma_m = std::sqrt(state.p(at, at) + state.p(0, 0) + state.p(1, 1));
  int seen = 0;
  int through = 0;
  int on = 0;
  for (long k = range.first; k <= range.first + range.count; k += stride) {
    if (k < 0 || k >= size) {
      continue;
    }
    const double angle_rad = scan.angle_rad(static_cast<std::size_t>(k));
    const double cosine = normal.dot(Point2(std::cos(angle_rad), std::sin(angle_rad)));
    const double measured_m = scan.ranges_m[static_cast<std::size_t>(k)];
    if (cosine < std::sin(params.grazing_rad) || !std::isfinite(measured_m)) {
      continue;
    }
    const double margin_m = (params.margin_m + 3.0 * sigma_m) / cosine;
    const double beyond_m = measured_m - distance_m / cosine;
    through += beyond_m > margin_m ? 1 : 0;
    on += std::abs(beyond_m) <= margin_m ? 1 : 0;
    ++seen;
  }
  if (seen >= params.min_beams && through >= params.denied * seen) {
    return Sight::kDenied;
  }
  return on > through ? Sight::kConfirmed : Sight::kNothing;
}

}  // namespace seeker::slam
