#include "server/search/triangulation.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "common/core/angle.hpp"

namespace seeker::search {
namespace {

constexpr int kMaxIterations = 10;
constexpr double kConverged_m = 1e-6;
constexpr double kMinRange_m = 1e-3;
constexpr double kMinDeterminant = 1e-9;

double heading_of(const BearingRange& s) { return s.map_T_camera.theta_rad + s.bearing_rad; }

double largest_parallax(const std::vector<BearingRange>& sightings) {
  double largest = 0.0;
  for (std::size_t a = 0; a < sightings.size(); ++a) {
    for (std::size_t b = a + 1; b < sightings.size(); ++b) {
      largest = std::max(largest, std::abs(wrap_angle(heading_of(sightings[a]) - heading_of(sightings[b]))));
    }
  }
  return largest;
}

/// Point with the least squared distance to all bearing lines.
std::optional<Point2> intersect(const std::vector<BearingRange>& sightings) {
  Matrix2 normal = Matrix2::Zero();
  Point2 right = Point2::Zero();
  for (const BearingRange& s : sightings) {
    const Point2 across(-std::sin(heading_of(s)), std::cos(heading_of(s)));
    const Matrix2 projector = across * across.transpose();
    normal += projector;
    right += projector * s.map_T_camera.translation();
  }
  if (std::abs(normal.determinant()) < kMinDeterminant) {
    return std::nullopt;
  }
  return Point2(normal.inverse() * right);
}

std::optional<Point2> first_guess(const std::vector<BearingRange>& sightings, double min_parallax_rad) {
  for (const BearingRange& s : sightings) {
    if (s.range_m) {
      return position_of(s).p_map;
    }
  }
  return largest_parallax(sightings) >= min_parallax_rad ? intersect(sightings) : std::nullopt;
}

/// Adds one scalar residual with its gradient to the normal equations.
struct NormalEquations {
  Matrix2 information = Matrix2::Zero();
  Point2 right = Point2::Zero();
  double chi2 = 0.0;

  void add(double residual, const Point2& gradient, double sigma) {
    const double weight = 1.0 / (sigma * sigma);
    information += weight * gradient * gradient.transpose();
    right += weight * residual * gradient;
    chi2 += weight * residual * residual;
  }
};

NormalEquations linearise(const std::vector<BearingRange>& sightings, const Point2& p) {
  NormalEquations equations;
  for (const BearingRange& s : sightings) {
    const Point2 d = p - s.map_T_camera.translation();
    const double r = std::max(d.norm(), kMinRange_m);
    const double bearing = wrap_angle(std::atan2(d.y(), d.x()) - s.map_T_camera.theta_rad);
    equations.add(wrap_angle(s.bearing_rad - bearing), Point2(-d.y(), d.x()) / (r * r), s.bearing_sigma_rad);
    if (s.range_m) {
      equations.add(*s.range_m - r, d / r, s.range_sigma_m);
    }
  }
  return equations;
}

bool in_front_of_all(const std::vector<BearingRange>& sightings, const Point2& p, double max_range_m) {
  return std::all_of(sightings.begin(), sightings.end(), [&](const BearingRange& s) {
    const Point2 d = p - s.map_T_camera.translation();
    return d.norm() <= max_range_m && std::abs(wrap_angle(std::atan2(d.y(), d.x()) - heading_of(s))) < kPi / 4.0;
  });
}

}  // namespace

PositionEstimate position_of(const BearingRange& sighting) {
  const double heading = heading_of(sighting);
  const double range = sighting.range_m.value_or(0.0);
  const Point2 along(std::cos(heading), std::sin(heading));
  const Point2 across(-along.y(), along.x());
  const double across_sigma = range * sighting.bearing_sigma_rad;
  PositionEstimate estimate;
  estimate.p_map = sighting.map_T_camera.translation() + range * along;
  estimate.covariance = sighting.range_sigma_m * sighting.range_sigma_m * along * along.transpose() +
                        across_sigma * across_sigma * across * across.transpose();
  return estimate;
}

std::optional<PositionEstimate> estimate_position(const std::vector<BearingRange>& sightings, double min_parallax_rad,
                                                  double max_range_m) {
  auto p = first_guess(sightings, min_parallax_rad);
  if (!p) {
    return std::nullopt;
  }
  for (int k = 0; k < kMaxIterations; ++k) {
    const NormalEquations equations = linearise(sightings, *p);
    if (equations.information.determinant() < kMinDeterminant) {
      return std::nullopt;
    }
    const Point2 step = equations.information.ldlt().solve(equations.right);
    *p += step;
    if (!p->allFinite()) {
      return std::nullopt;
    }
    if (step.norm() < kConverged_m) {
      break;
    }
  }
  if (!in_front_of_all(sightings, *p, max_range_m)) {
    return std::nullopt;
  }
  const NormalEquations last = linearise(sightings, *p);
  return PositionEstimate{*p, last.information.inverse(), last.chi2};
}

Matrix2 pose_contribution(const Point2& p_map, const Pose2& map_T_base, const Matrix3& pose_covariance) {
  const Point2 d = p_map - map_T_base.translation();
  Eigen::Matrix<double, 2, 3> jacobian;
  jacobian << 1.0, 0.0, -d.y(), 0.0, 1.0, d.x();
  return jacobian * pose_covariance * jacobian.transpose();
}

}  // namespace seeker::search
