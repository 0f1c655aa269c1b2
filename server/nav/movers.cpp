#include "server/nav/movers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace seeker::nav {
namespace {

/// Slower ones stand.
constexpr double kStanding_m_s = 0.02;
constexpr double kStep_s = 0.1;
/// Motions are predicted for at most this time.
constexpr double kLongest_s = 5.0;
/// Coming nearer by less is no coming nearer.
constexpr double kCloser_m = 0.005;
constexpr std::array<double, 5> kShares{1.0, 0.75, 0.5, 0.25, 0.0};

/// One that drives on for some time, then brakes until it stands.
struct Braking {
  Pose2 frame_T_base;
  Twist2 velocity;
  double drives_on_s = 0.0;
  double decel_m_s2 = 0.3;

  [[nodiscard]] double time_s() const { return drives_on_s + std::abs(velocity.v_m_s) / decel_m_s2; }
  /// On the arc of its velocity, t seconds from now.
  [[nodiscard]] Pose2 at(double t_s) const {
    const double speed_m_s = std::abs(velocity.v_m_s);
    if (speed_m_s < kStanding_m_s) {
      return frame_T_base;
    }
    const double braking_s = std::clamp(t_s - drives_on_s, 0.0, speed_m_s / decel_m_s2);
    const double distance_m =
        speed_m_s * (std::min(t_s, drives_on_s) + braking_s) - 0.5 * decel_m_s2 * braking_s * braking_s;
    return frame_T_base * integrate(velocity, distance_m / speed_m_s);
  }
};

/// How near the two centres come.
double nearest_m(const Braking& own, const Braking& other) {
  const double until_s = std::min(kLongest_s, std::max(own.time_s(), other.time_s()));
  double nearest = distance_m(own.frame_T_base, other.frame_T_base);
  for (double t_s = kStep_s; t_s < until_s + kStep_s; t_s += kStep_s) {
    nearest = std::min(nearest, distance_m(own.at(t_s), other.at(t_s)));
  }
  return nearest;
}

/// Commanded to drive slower than it does, the base brakes at once, and continues to brake if it is not slow enough
/// when the next command may come; otherwise it drives as commanded until then.
Braking braking_towards(const Twist2& twist, const Twist2& present, const ClearanceParams& params) {
  const double slower_m_s = std::abs(present.v_m_s) - std::abs(twist.v_m_s);
  const double drives_on_s = params.reaction_s - std::max(0.0, slower_m_s) / params.decel_m_s2;
  return {{}, slower_m_s > 0.0 ? present : twist, std::max(0.0, drives_on_s), params.decel_m_s2};
}

}  // namespace

bool Mover::may_cover(const Point2& p_frame) const {
  return (p_frame - frame_T_base.translation()).norm() <= radius_m + slack_m;
}

std::vector<Mover> moved(std::vector<Mover> movers, const Pose2& new_T_old) {
  for (Mover& mover : movers) {
    mover.frame_T_base = new_T_old * mover.frame_T_base;
  }
  return movers;
}

LaserScan without_movers(LaserScan scan, const Pose2& map_T_base, const std::vector<Mover>& movers_map) {
  const std::vector<Mover> movers = moved(movers_map, inverse(map_T_base * scan.base_T_laser));
  for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
    const double range_m = scan.ranges_m[beam];
    const double angle_rad = scan.angle_rad(beam);
    const Point2 p_laser(range_m * std::cos(angle_rad), range_m * std::sin(angle_rad));
    if (std::isfinite(range_m) &&
        std::any_of(movers.begin(), movers.end(), [&](const Mover& mover) { return mover.may_cover(p_laser); })) {
      if (scan.quality.empty()) {
        scan.quality.assign(scan.ranges_m.size(), 1);
      }
      scan.quality[beam] = 0;
    }
  }
  return scan;
}

Twist2 limit_for_movers(const Twist2& wanted, const Twist2& present, const std::vector<Mover>& movers_base,
                        const ClearanceParams& params) {
  const auto room_m = [&](const Twist2& twist) {
    double room = kCloser_m;
    for (const Mover& mover : movers_base) {
      if (std::abs(mover.velocity.v_m_s) >= kStanding_m_s) {
        const double apart_m = std::min(params.radius_m + mover.radius_m + mover.slack_m,
                                        mover.frame_T_base.translation().norm() - kCloser_m);
        const Braking other{mover.frame_T_base, mover.velocity, params.reaction_s, params.decel_m_s2};
        room = std::min(room, nearest_m(braking_towards(twist, present, params), other) - apart_m);
      }
    }
    return room;
  };
  Twist2 best = wanted;
  double best_m = -1.0e9;
  for (const double share : kShares) {
    const Twist2 twist{share * wanted.v_m_s, share > 0.0 ? share * wanted.omega_rad_s : wanted.omega_rad_s};
    const double room = room_m(twist);
    if (room >= 0.0) {
      return twist;
    }
    if (room > best_m) {
      best = twist;
      best_m = room;
    }
  }
  return best;
}

}  // namespace seeker::nav
