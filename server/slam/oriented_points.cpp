#include "server/slam/oriented_points.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace seeker::slam {
namespace {

/// Beams as points in the frame `laser`, with holes where nothing usable came back.
struct BeamPoints {
  std::vector<Point2> p;
  std::vector<bool> valid;
};

BeamPoints beam_points(const LaserScan& scan) {
  BeamPoints beams{std::vector<Point2>(scan.ranges_m.size(), Point2::Zero()),
                   std::vector<bool>(scan.ranges_m.size(), false)};
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double range_m = scan.ranges_m[i];
    const bool weak = !scan.quality.empty() && scan.quality[i] == 0;
    if (std::isfinite(range_m) && range_m > 0.0 && range_m >= scan.range_min_m && range_m <= scan.range_max_m &&
        !weak) {
      const double angle_rad = scan.angle_rad(i);
      beams.p[i] = {range_m * std::cos(angle_rad), range_m * std::sin(angle_rad)};
      beams.valid[i] = true;
    }
  }
  return beams;
}

std::optional<Point2> normal_at(const BeamPoints& beams, std::size_t beam, double radius_m,
                                const NormalParams& params) {
  const Point2 centre = beams.p[beam];
  const auto reach = static_cast<std::size_t>(params.neighbours);
  const std::size_t first = beam >= reach ? beam - reach : 0;
  const std::size_t last = std::min(beam + reach, beams.p.size() - 1);
  Point2 sum = Point2::Zero();
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  int count = 0;
  for (std::size_t k = first; k <= last; ++k) {
    const Point2 d = beams.p[k] - centre;
    if (beams.valid[k] && d.squaredNorm() <= radius_m * radius_m) {
      sum += d;
      xx += d.x() * d.x();
      xy += d.x() * d.y();
      yy += d.y() * d.y();
      ++count;
    }
  }
  if (count < params.min_points) {
    return std::nullopt;
  }
  const Point2 mean = sum / count;
  const double cxx = xx / count - mean.x() * mean.x();
  const double cxy = xy / count - mean.x() * mean.y();
  const double cyy = yy / count - mean.y() * mean.y();
  const double half_gap = std::hypot((cxx - cyy) / 2.0, cxy);
  const double large = (cxx + cyy) / 2.0 + half_gap;
  const double small = std::max(0.0, (cxx + cyy) / 2.0 - half_gap);
  if (large <= 0.0 || small > params.max_thickness_ratio * params.max_thickness_ratio * large) {
    return std::nullopt;
  }
  const double along_rad = 0.5 * std::atan2(2.0 * cxy, cxx - cyy);
  const Point2 normal(-std::sin(along_rad), std::cos(along_rad));
  return normal.dot(centre) > 0.0 ? Point2(-normal) : normal;
}

}  // namespace

std::vector<OrientedPoint> oriented_points(const LaserScan& scan, const NormalParams& params) {
  std::vector<OrientedPoint> points;
  const BeamPoints beams = beam_points(scan);
  for (std::size_t i = 0; i < beams.p.size(); ++i) {
    if (!beams.valid[i]) {
      continue;
    }
    const double spacing_m = beams.p[i].norm() * std::abs(scan.angle_step_rad);
    const double radius_m = std::max(params.radius_m, params.spacings * spacing_m);
    if (const auto normal = normal_at(beams, i, radius_m, params)) {
      points.push_back(transform(scan.base_T_laser, {beams.p[i], *normal}));
    }
  }
  return points;
}

std::vector<OrientedPoint> thin_out(const std::vector<OrientedPoint>& points, std::size_t limit) {
  if (points.size() <= limit) {
    return points;
  }
  std::vector<OrientedPoint> kept;
  kept.reserve(limit);
  for (std::size_t k = 0; k < limit; ++k) {
    kept.push_back(points[k * points.size() / limit]);
  }
  return kept;
}

OrientedPoint transform(const Pose2& a_T_b, const OrientedPoint& point_b) {
  const double c = std::cos(a_T_b.theta_rad);
  const double s = std::sin(a_T_b.theta_rad);
  const auto turn = [&](const Point2& v) { return Point2(c * v.x() - s * v.y(), s * v.x() + c * v.y()); };
  return {turn(point_b.p) + a_T_b.translation(), turn(point_b.normal)};
}

}  // namespace seeker::slam
