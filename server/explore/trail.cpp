#include "server/explore/trail.hpp"

#include <algorithm>
#include <cmath>

namespace seeker::explore {
namespace {

constexpr double kSpacing_m = 0.5;
constexpr double kWaypoint_m = 2.0;
constexpr std::size_t kMaxPoints = 4096;

}  // namespace

double position_sigma_m(const Matrix3& covariance) {
  const double a = covariance(0, 0);
  const double c = covariance(1, 1);
  const double b = 0.5 * (covariance(0, 1) + covariance(1, 0));
  return std::sqrt(std::max(0.0, 0.5 * (a + c) + std::hypot(0.5 * (a - c), b)));
}

void Trail::note(const Point2& p_map, double sigma_m) {
  if (!points_.empty() && (points_.back().p_map - p_map).norm() < kSpacing_m) {
    return;
  }
  if (points_.size() >= kMaxPoints) {
    std::size_t kept = 0;
    for (std::size_t k = 0; k < points_.size(); k += 2) {
      points_[kept++] = points_[k];
    }
    points_.resize(kept);
  }
  points_.push_back({p_map, sigma_m});
}

std::vector<Point2> Trail::path_to_certainty() const {
  std::vector<Point2> path;
  if (points_.empty()) {
    return path;
  }
  // Of places equally certain the last: it is the nearest along the trail.
  std::size_t best = 0;
  for (std::size_t k = 1; k < points_.size(); ++k) {
    best = points_[k].sigma_m <= points_[best].sigma_m ? k : best;
  }
  Point2 last = points_.back().p_map;
  for (std::size_t k = points_.size(); k-- > 0;) {
    if (k == best || k == 0 || (points_[k].p_map - last).norm() >= kWaypoint_m) {
      path.push_back(points_[k].p_map);
      last = points_[k].p_map;
    }
  }
  return path;
}

std::vector<Point2> Trail::certain_places(double sigma_m) const {
  std::vector<Point2> places;
  for (const TrailPoint& point : points_) {
    if (point.sigma_m <= sigma_m) {
      places.push_back(point.p_map);
    }
  }
  return places;
}

void Trail::cut_after(const Point2& p_map) {
  const auto nearest = std::min_element(points_.begin(), points_.end(), [&](const TrailPoint& a, const TrailPoint& b) {
    return (a.p_map - p_map).squaredNorm() < (b.p_map - p_map).squaredNorm();
  });
  if (nearest != points_.end()) {
    points_.erase(nearest + 1, points_.end());
  }
}

void Trail::transform(const MapMove& move) {
  for (TrailPoint& point : points_) {
    point.p_map = move * point.p_map;
  }
}

}  // namespace seeker::explore
