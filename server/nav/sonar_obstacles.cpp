#include "server/nav/sonar_obstacles.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/angle.hpp"

namespace seeker::nav {
namespace {

/// Farther echoes are too inaccurate to locate the object.
constexpr double kNear_m = 0.7;
constexpr double kFront_rad = deg_to_rad(60.0);
/// A laser return within this distance of the echo is the same object: the cone is wide, the echo's place is not exact.
constexpr double kExplained_m = 0.3;
constexpr double kSameEcho_m = 0.15;
constexpr int kTimes = 4;
constexpr double kForget_s = 2.0;

bool explained(const Point2& echo_base, double range_m, const Pose2& base_T_sonar, double half_angle_rad,
               const std::vector<Point2>& returns_base) {
  return std::any_of(returns_base.begin(), returns_base.end(), [&](const Point2& p) {
    if ((p - echo_base).norm() < kExplained_m) {
      return true;
    }
    // Anything in the cone at that range answers, not only what lies on its axis.
    const Point2 from_sonar = p - base_T_sonar.translation();
    return std::abs(from_sonar.norm() - range_m) < kExplained_m &&
           std::abs(bearing_to(base_T_sonar, p)) < 2.0 * half_angle_rad;
  });
}

}  // namespace

void SonarObstacles::note(const DriveInput& input) {
  if (input.sonar == nullptr || input.laser == nullptr || input.sonar->stamp == stamp_) {
    return;  // without a laser the map itself is made of echoes
  }
  stamp_ = input.sonar->stamp;
  std::erase_if(echoes_, [&](const Echo& echo) { return to_seconds(input.now - echo.seen) > kForget_s; });
  const std::vector<Point2> returns_base = points_in_base(*input.laser);
  for (const SonarReading& reading : input.sonar->readings) {
    const Pose2& mount = reading.base_T_sonar;
    if (!std::isfinite(reading.range_m) || reading.range_m > kNear_m || std::abs(mount.theta_rad) > kFront_rad) {
      continue;
    }
    const Point2 echo = mount * Point2(reading.range_m, 0.0);
    if (!explained(echo, reading.range_m, mount, input.sonar->cone_half_angle_rad, returns_base)) {
      note_echo(input.map_T_base * echo, input);
    }
  }
}

void SonarObstacles::note_echo(const Point2& p_map, const DriveInput& input) {
  const auto known = std::find_if(echoes_.begin(), echoes_.end(),
                                  [&](const Echo& echo) { return (echo.p_map - p_map).norm() < kSameEcho_m; });
  if (known == echoes_.end()) {
    echoes_.push_back({p_map, input.now, 1});
    return;
  }
  known->seen = input.now;
  if (++known->times >= kTimes) {
    input.floors.add_obstacle(known->p_map);
  }
}

void SonarObstacles::transform(const MapMove& move) {
  for (Echo& echo : echoes_) {
    echo.p_map = move * echo.p_map;
  }
}

}  // namespace seeker::nav
