#include "server/slam/oriented_points.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "server/lines/line_fit.hpp"

namespace seeker::slam {
namespace {

/// What came back, in the order of the beams and in the frame `laser`.
struct Returns {
  std::vector<float> ranges_m;
  std::vector<std::int32_t> beams;
  std::vector<Point2> p;
};

Returns returns_of(const LaserScan& scan) {
  Returns returns;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double range_m = scan.ranges_m[i];
    const bool weak = !scan.quality.empty() && scan.quality[i] == 0;
    if (std::isfinite(range_m) && range_m > 0.0 && range_m >= scan.range_min_m && range_m <= scan.range_max_m &&
        !weak) {
      const double angle_rad = scan.angle_rad(i);
      returns.ranges_m.push_back(scan.ranges_m[i]);
      returns.beams.push_back(static_cast<std::int32_t>(i));
      returns.p.emplace_back(range_m * std::cos(angle_rad), range_m * std::sin(angle_rad));
    }
  }
  return returns;
}

lines::RangeNoise estimated_noise(const Returns& returns, double step_rad) {
  lines::NoiseEstimator estimator;
  std::vector<float> squares_m2;
  estimator.differences(returns.ranges_m, returns.beams, step_rad, 0, squares_m2);
  return estimator.estimate(returns.ranges_m, squares_m2, {});
}

/// Over the first points, so that those of any run are a difference.
std::vector<lines::Moments> running_sums(const std::vector<Point2>& points) {
  std::vector<lines::Moments> sums(points.size() + 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    sums[i + 1] = sums[i];
    sums[i + 1].add(points[i].x(), points[i].y(), 1.0);
  }
  return sums;
}

/// The points first..last about one.
struct Run {
  std::size_t first;
  std::size_t last;
};

/// At most `neighbours` beams to either side and within the radius.
Run nearby(const Returns& returns, std::size_t centre, int neighbours, double radius_m) {
  const auto belongs = [&](std::size_t k) {
    return std::abs(returns.beams[k] - returns.beams[centre]) <= neighbours &&
           (returns.p[k] - returns.p[centre]).squaredNorm() <= radius_m * radius_m;
  };
  Run run{centre, centre};
  while (run.first > 0 && belongs(run.first - 1)) {
    --run.first;
  }
  while (run.last + 1 < returns.p.size() && belongs(run.last + 1)) {
    ++run.last;
  }
  return run;
}

/// The normal of the line through the run of points, oriented towards the sensor; no value when they form no line.
std::optional<Point2> normal_of(const std::vector<lines::Moments>& sums, const Run& run, const Point2& centre,
                                int min_points, double max_thickness_ratio) {
  const lines::Moments moments = sums[run.last + 1] - sums[run.first];
  if (moments.w < min_points) {
    return std::nullopt;
  }
  const lines::LineFit fit = lines::fit_line(moments);
  if (fit.along_m2 <= 0.0 || fit.across_m2 > max_thickness_ratio * max_thickness_ratio * fit.along_m2) {
    return std::nullopt;
  }
  return fit.normal.dot(centre) > 0.0 ? Point2(-fit.normal) : fit.normal;
}

}  // namespace

std::vector<OrientedPoint> oriented_points(const LaserScan& scan, const NormalParams& params,
                                           const std::optional<lines::RangeNoise>& noise) {
  const Returns returns = returns_of(scan);
  const double step_rad = std::abs(scan.angle_step_rad);
  const lines::RangeNoise known = noise ? *noise : estimated_noise(returns, step_rad);
  const std::vector<lines::Moments> sums = running_sums(returns.p);
  std::vector<OrientedPoint> points;
  points.reserve(returns.p.size());
  for (std::size_t i = 0; i < returns.p.size(); ++i) {
    const double range_m = static_cast<double>(returns.ranges_m[i]);
    const double radius_m = std::max(params.radius_m, params.spacings * range_m * step_rad);
    const Run few = nearby(returns, i, params.neighbours, radius_m);
    std::optional<Point2> normal = normal_of(sums, few, returns.p[i], params.min_points, params.max_thickness_ratio);
    const double reach_m = std::min(params.max_reach_m, params.noise_sigmas * known.sigma_m(range_m));
    if (!normal && reach_m > params.neighbours * range_m * step_rad) {
      const auto beams = static_cast<int>(std::ceil(reach_m / (range_m * step_rad)));
      const Run more = nearby(returns, i, beams, reach_m);
      normal = normal_of(sums, more, returns.p[i], params.min_points, params.noisy_thickness_ratio);
    }
    if (normal) {
      points.push_back(transform(scan.base_T_laser, {returns.p[i], *normal}));
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
