#include "server/search/target_range.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "common/core/angle.hpp"

namespace seeker::search {
namespace {

constexpr double kMaxSonarDisagreement_m = 0.5;
/// Neighbouring returns farther apart than this belong to two objects.
constexpr double kOutlineJump_m = 0.12;
/// Width of an outline as a share of the object's: its diagonal at most, with some room for noise.
constexpr double kLeastOutline = 0.7;
constexpr double kMostOutline = 1.6;

/// An echo as the camera would see it.
struct Echo {
  double bearing_rad = 0.0;  ///< relative to the wanted direction
  double range_m = 0.0;      ///< infinite: no echo
};

std::vector<Echo> echoes_about(const SonarScan& scan, double bearing_base_rad, const DetectionParams& params) {
  const Pose2 camera_T_base = inverse(params.base_T_camera);
  std::vector<Echo> echoes;
  for (const SonarReading& reading : scan.readings) {
    const double axis = wrap_angle(reading.base_T_sonar.theta_rad - bearing_base_rad);
    if (!std::isfinite(reading.range_m) || reading.range_m > params.sonar_max_range_m) {
      echoes.push_back({axis, std::numeric_limits<double>::infinity()});
      continue;
    }
    if (params.sonar_radius_m > 0.0) {
      echoes.push_back({axis, reading.range_m + params.sonar_radius_m});
      continue;
    }
    const Point2 p = camera_T_base * (reading.base_T_sonar * Point2(reading.range_m, 0.0));
    const double seen = std::atan2(p.y(), p.x()) + params.base_T_camera.theta_rad;
    echoes.push_back({wrap_angle(seen - bearing_base_rad), p.norm()});
  }
  return echoes;
}

bool accept(const std::optional<RangeReading>& reading, std::optional<double> hint_m, const DetectionParams& params) {
  return reading && (!hint_m || std::abs(reading->range_m - *hint_m) <= params.size_range_factor * *hint_m);
}

}  // namespace

std::optional<RangeReading> lidar_range(const LaserScan& scan, double bearing_base_rad, const DetectionParams& params) {
  const Pose2 camera_T_base = inverse(params.base_T_camera);
  const double bearing_camera = bearing_base_rad - params.base_T_camera.theta_rad;
  std::vector<double> ranges;
  for (const Point2& p_base : points_in_base(scan)) {
    const Point2 p = camera_T_base * p_base;
    if (std::abs(wrap_angle(std::atan2(p.y(), p.x()) - bearing_camera)) <= params.lidar_window_rad &&
        p.norm() <= params.lidar_max_range_m) {
      ranges.push_back(p.norm());
    }
  }
  if (ranges.empty()) {
    return std::nullopt;
  }
  const auto middle = ranges.begin() + static_cast<std::ptrdiff_t>(ranges.size() / 2);
  std::nth_element(ranges.begin(), middle, ranges.end());
  return RangeReading{*middle, params.lidar_sigma_m, RangeSource::kLidar};
}

std::optional<RangeReading> sonar_range(const SonarScan& scan, double bearing_base_rad, const DetectionParams& params) {
  std::optional<Echo> left;
  std::optional<Echo> right;
  for (const Echo& echo : echoes_about(scan, bearing_base_rad, params)) {
    if (echo.bearing_rad >= 0.0 && (!left || echo.bearing_rad < left->bearing_rad)) {
      left = echo;
    }
    if (echo.bearing_rad < 0.0 && (!right || echo.bearing_rad > right->bearing_rad)) {
      right = echo;
    }
  }
  const auto reading = [&](double range) { return RangeReading{range, params.sonar_sigma_m, RangeSource::kSonar}; };
  const bool between = left && right && left->bearing_rad - right->bearing_rad < kPi / 2.0;
  if (between && std::isfinite(left->range_m) && std::isfinite(right->range_m) &&
      std::abs(left->range_m - right->range_m) <= kMaxSonarDisagreement_m) {
    const double share = -right->bearing_rad / std::max(left->bearing_rad - right->bearing_rad, 1e-9);
    return reading(right->range_m + share * (left->range_m - right->range_m));
  }
  // Disagreement or the end of the ring: the transducer whose own cone holds the direction.
  std::optional<Echo> nearest;
  for (const auto& echo : {left, right}) {
    if (echo && std::isfinite(echo->range_m) && std::abs(echo->bearing_rad) <= scan.cone_half_angle_rad &&
        (!nearest || std::abs(echo->bearing_rad) < std::abs(nearest->bearing_rad))) {
      nearest = echo;
    }
  }
  return nearest ? std::optional(reading(nearest->range_m)) : std::nullopt;
}

std::optional<RangeReading> range_in_direction(double bearing_base_rad, const LaserScan* laser, const SonarScan* sonar,
                                               std::optional<double> hint_m, const DetectionParams& params) {
  if (laser != nullptr) {
    if (const auto reading = lidar_range(*laser, bearing_base_rad, params); accept(reading, hint_m, params)) {
      return reading;
    }
  }
  if (sonar != nullptr) {
    if (const auto reading = sonar_range(*sonar, bearing_base_rad, params); accept(reading, hint_m, params)) {
      return reading;
    }
  }
  return std::nullopt;
}

std::optional<double> outline_bearing(const LaserScan& scan, double bearing_base_rad, double range_m, double width_m,
                                      const DetectionParams& params) {
  const std::vector<Point2> points = points_in_base(scan);
  const Pose2 camera_T_base = inverse(params.base_T_camera);
  const auto bearing_of = [&](const Point2& p_base) {
    const Point2 p = camera_T_base * p_base;
    return wrap_angle(std::atan2(p.y(), p.x()) + params.base_T_camera.theta_rad);
  };
  std::optional<std::size_t> seed;
  double nearest_rad = params.lidar_window_rad;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double off_rad = std::abs(wrap_angle(bearing_of(points[i]) - bearing_base_rad));
    if (off_rad <= nearest_rad && std::abs((camera_T_base * points[i]).norm() - range_m) <= kOutlineJump_m) {
      nearest_rad = off_rad;
      seed = i;
    }
  }
  if (!seed) {
    return std::nullopt;
  }
  std::size_t first = *seed;
  std::size_t last = *seed;
  while (first > 0 && (points[first - 1] - points[first]).norm() <= kOutlineJump_m) {
    --first;
  }
  while (last + 1 < points.size() && (points[last + 1] - points[last]).norm() <= kOutlineJump_m) {
    ++last;
  }
  const double across_m = (points[last] - points[first]).norm();
  if (across_m < kLeastOutline * width_m || across_m > kMostOutline * width_m) {
    return std::nullopt;
  }
  const double left_rad = bearing_of(points[last]);
  return wrap_angle(left_rad + wrap_angle(bearing_of(points[first]) - left_rad) / 2.0);
}

}  // namespace seeker::search
