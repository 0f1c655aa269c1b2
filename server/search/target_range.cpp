#include "server/search/target_range.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "common/core/angle.hpp"

namespace seeker::search {
namespace {

constexpr double kMaxSonarDisagreement_m = 0.5;

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
    if (echo && std::isfinite(echo->range_m) && std::abs(echo->bearing_rad) <= scan.cone_half_angle_rad / 2.0 &&
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

}  // namespace seeker::search
