#include "server/nav/clearance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "common/core/angle.hpp"

namespace seeker::nav {
namespace {

/// Arcs of a larger radius are straight lines within the horizon to better than a millimetre per metre.
constexpr double kStraightRadius_m = 1000.0;
constexpr double kStandingSpeed_m_s = 1e-4;

/// Shares of the rotation speed that are tried where the whole of it leads to a contact, the largest first.
constexpr std::array kReducedRotations{0.75, 0.5, 0.25, 0.0};

/// Shares of the present rotation that are mixed with the wanted one where that leads to a contact, the smallest first.
constexpr std::array kKeptRotations{0.25, 0.5, 0.75, 1.0};

/// Places of the arc, evenly spread over the time that braking takes, at which the command may end.
constexpr int kCutPlaces = 4;
/// Shares of the wanted velocity that are tried, in equal steps down to none.
constexpr int kSpeedSteps = 10;

/// Distance along +x until a disc of `radius_m` touches p. Nothing: it never does.
std::optional<double> straight_contact(const Point2& p, double radius_m) {
  if (p.x() <= 0.0 || std::abs(p.y()) >= radius_m) {
    return std::nullopt;
  }
  return std::max(0.0, p.x() - std::sqrt(radius_m * radius_m - p.y() * p.y()));
}

/// The same along the circle of signed radius `turn_radius_m` (positive: to the left) that starts along +x.
std::optional<double> arc_contact(const Point2& p, double turn_radius_m, double radius_m) {
  const double turn_radius_abs_m = std::abs(turn_radius_m);
  const Point2 from_centre = p - Point2(0.0, turn_radius_m);
  const double rho = from_centre.norm();
  if (std::abs(rho - turn_radius_abs_m) >= radius_m || rho <= 0.0) {
    return std::nullopt;
  }
  const double side = turn_radius_m > 0.0 ? 1.0 : -1.0;
  // Angle from the robot to the point about the centre of the circle, in the direction of travel, 0..2 pi.
  double ahead_rad = std::atan2(from_centre.x(), -side * from_centre.y());
  if (ahead_rad < 0.0) {
    ahead_rad += kTwoPi;
  }
  if (p.norm() < radius_m) {
    return ahead_rad < kPi ? std::optional<double>(0.0) : std::nullopt;
  }
  const double cosine =
      (rho * rho + turn_radius_abs_m * turn_radius_abs_m - radius_m * radius_m) / (2.0 * rho * turn_radius_abs_m);
  return turn_radius_abs_m * std::max(0.0, ahead_rad - std::acos(std::clamp(cosine, -1.0, 1.0)));
}

/// Whether a base that turns at `omega_rad_s` while it brakes from `v_m_s` may go straight on at any time.
bool may_go_straight_on(double v_m_s, double omega_rad_s, const std::vector<Point2>& points_base,
                        const ClearanceParams& params) {
  for (int place = 0; place < kCutPlaces; ++place) {
    const double braked = static_cast<double>(place) / kCutPlaces;
    const double v_then_m_s = v_m_s * (1.0 - braked);
    // The way so far, as the time it takes at the full speed.
    const double way_s = std::abs(v_m_s) / params.decel_m_s2 * (braked - braked * braked / 2.0);
    const Pose2 then_T_base = inverse(integrate({v_m_s, omega_rad_s}, way_s));
    std::vector<Point2> points_then(points_base.size());
    std::transform(points_base.begin(), points_base.end(), points_then.begin(),
                   [&](const Point2& p_base) { return then_T_base * p_base; });
    const double needed_m = std::abs(v_then_m_s) * params.reaction_s +
                            v_then_m_s * v_then_m_s / (2.0 * params.decel_m_s2) + params.slow_margin_m;
    if (free_arc_m({v_then_m_s, 0.0}, points_then, params) < std::min(needed_m, params.horizon_m)) {
      return false;
    }
  }
  return true;
}

/// The first of `wanted_rad_s` and `others_rad_s` with which a base that rolls at `v_m_s` has room to brake; where none
/// has, the one with the most room.
template <std::size_t N>
double rotation_with_room(double wanted_rad_s, const std::array<double, N>& others_rad_s, double v_m_s,
                          const std::vector<Point2>& points_base, const ClearanceParams& params) {
  const double braking_m = v_m_s * v_m_s / (2.0 * params.decel_m_s2) + params.slow_margin_m;
  double best_rad_s = wanted_rad_s;
  double best_m = free_arc_m({v_m_s, wanted_rad_s}, points_base, params);
  for (const double omega_rad_s : others_rad_s) {
    if (best_m >= braking_m) {
      break;
    }
    if (const double distance_m = free_arc_m({v_m_s, omega_rad_s}, points_base, params); distance_m > best_m) {
      best_rad_s = omega_rad_s;
      best_m = distance_m;
    }
  }
  return best_rad_s;
}

}  // namespace

double free_arc_m(const Twist2& twist, const std::vector<Point2>& points_base, const ClearanceParams& params) {
  if (std::abs(twist.v_m_s) < kStandingSpeed_m_s) {
    return params.horizon_m;
  }
  // Driving backwards is driving forwards in the mirrored frame (x -> -x), where left and right are exchanged.
  const double mirror = twist.v_m_s > 0.0 ? 1.0 : -1.0;
  const double turn_radius_m =
      twist.omega_rad_s != 0.0 ? std::abs(twist.v_m_s) / (mirror * twist.omega_rad_s) : 2.0 * kStraightRadius_m;
  double free_m = params.horizon_m;
  for (const Point2& point : points_base) {
    if (point.norm() < params.self_radius_m) {
      continue;
    }
    const Point2 p(mirror * point.x(), point.y());
    const auto contact = std::abs(turn_radius_m) > kStraightRadius_m ? straight_contact(p, params.radius_m)
                                                                     : arc_contact(p, turn_radius_m, params.radius_m);
    free_m = std::min(free_m, contact.value_or(params.horizon_m));
  }
  return free_m;
}

Twist2 limit_for_clearance(const Twist2& twist, const std::vector<Point2>& points_base, const ClearanceParams& params) {
  const double free_m = free_arc_m(twist, points_base, params);
  if (free_m >= params.horizon_m) {
    return twist;
  }
  const double room_m = free_m - params.slow_margin_m;
  if (room_m <= 0.0) {
    return {0.0, twist.omega_rad_s};
  }
  // v * reaction + v^2 / (2 decel) = room
  const double lag_v = params.decel_m_s2 * params.reaction_s;
  const double allowed = std::sqrt(lag_v * lag_v + 2.0 * params.decel_m_s2 * room_m) - lag_v;
  const double scale = std::min(1.0, allowed / std::abs(twist.v_m_s));
  return {scale * twist.v_m_s, scale * twist.omega_rad_s};
}

Twist2 limit_rotation_while_rolling(const Twist2& allowed, const Twist2& present,
                                    const std::vector<Point2>& points_base, const ClearanceParams& params) {
  if (std::abs(present.v_m_s) <= std::abs(allowed.v_m_s)) {
    return allowed;
  }
  std::array<double, kReducedRotations.size()> reduced_rad_s{};
  std::transform(kReducedRotations.begin(), kReducedRotations.end(), reduced_rad_s.begin(),
                 [&](double share) { return share * allowed.omega_rad_s; });
  return {allowed.v_m_s, rotation_with_room(allowed.omega_rad_s, reduced_rad_s, present.v_m_s, points_base, params)};
}

Twist2 keep_arc_while_braking(const Twist2& wanted, const Twist2& present, const std::vector<Point2>& points_base,
                              const ClearanceParams& params) {
  if (std::abs(present.v_m_s) <= std::abs(wanted.v_m_s)) {
    return wanted;
  }
  std::array<double, kKeptRotations.size()> kept_rad_s{};
  std::transform(kKeptRotations.begin(), kKeptRotations.end(), kept_rad_s.begin(),
                 [&](double share) { return wanted.omega_rad_s + share * (present.omega_rad_s - wanted.omega_rad_s); });
  return {wanted.v_m_s, rotation_with_room(wanted.omega_rad_s, kept_rad_s, present.v_m_s, points_base, params)};
}

Twist2 limit_for_sudden_stop(const Twist2& wanted, const Twist2& present, const std::vector<Point2>& points_base,
                             const ClearanceParams& params) {
  for (int step = kSpeedSteps; step > 0; --step) {
    const double share = static_cast<double>(step) / kSpeedSteps;
    const Twist2 slower{share * wanted.v_m_s, share * wanted.omega_rad_s};
    if (may_go_straight_on(slower.v_m_s, slower.omega_rad_s, points_base, params) &&
        may_go_straight_on(slower.v_m_s, present.omega_rad_s, points_base, params)) {
      return slower;
    }
  }
  return {0.0, wanted.omega_rad_s};
}

}  // namespace seeker::nav
