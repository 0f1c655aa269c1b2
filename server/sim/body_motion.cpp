#include "server/sim/body_motion.hpp"

#include <algorithm>
#include <cmath>

namespace seeker::sim {
namespace {

constexpr double kFloorDust_m = 0.02;
constexpr double kRelease_m = 0.02;  ///< a touch ends when the body is this far away again

double approach(double present, double wanted, double step) {
  return present + std::clamp(wanted - present, -step, step);
}

}  // namespace

HeightBand body_band(const RobotModel& model) { return {kFloorDust_m, model.body_height_m}; }

Twist2 accelerate(const Twist2& present, const Twist2& wanted, const RobotModel& model, double dt_s) {
  const double v = std::clamp(wanted.v_m_s, -model.v_max_m_s, model.v_max_m_s);
  const double omega = std::clamp(wanted.omega_rad_s, -model.omega_max_rad_s, model.omega_max_rad_s);
  return {approach(present.v_m_s, v, model.acceleration_m_s2 * dt_s),
          approach(present.omega_rad_s, omega, model.angular_acceleration_rad_s2 * dt_s)};
}

Twist2 BodyMotion::step(const Twist2& wanted, const RobotModel& model, const Scene& scene, double dt_s) {
  const HeightBand band = body_band(model);
  const double limit_m = model.radius_m + kClearanceLimit_m;
  const Twist2 before = velocity_;
  velocity_ = accelerate(velocity_, wanted, model, dt_s);
  Twist2 mean{0.5 * (before.v_m_s + velocity_.v_m_s), 0.5 * (before.omega_rad_s + velocity_.omega_rad_s)};

  const double clearance_before_m = scene.clearance_m(world_T_base_.translation(), limit_m, band);
  Pose2 next = world_T_base_ * integrate(mean, dt_s);
  double clearance_m = scene.clearance_m(next.translation(), limit_m, band);
  // Moving away from what is touched stays possible. The middle of a body never comes near a surface, so the
  // distance cannot rise on the far side of a thin wall: nothing is tunnelled through.
  blocked_ = mean.v_m_s != 0.0 && clearance_m < model.radius_m && clearance_m <= clearance_before_m;
  if (blocked_) {
    mean.v_m_s = 0.0;
    velocity_.v_m_s = 0.0;
    next = world_T_base_ * integrate(mean, dt_s);
    clearance_m = clearance_before_m;
    contacts_ += touching_ ? 0 : 1;
    touching_ = true;
  } else if (clearance_m > model.radius_m + kRelease_m) {
    touching_ = false;
  }
  path_length_m_ += std::abs(mean.v_m_s) * dt_s;
  world_T_base_ = next;
  min_clearance_m_ = touching_ ? 0.0 : std::min(min_clearance_m_, std::max(0.0, clearance_m - model.radius_m));
  return mean;
}

void Encoders::step(const Twist2& twist, double dt_s, const RobotModel& model, Rng& rng) {
  velocity_ = {};
  if (twist == Twist2{}) {
    return;
  }
  const OdometryModel& m = model.odometry;
  const double distance_m = twist.v_m_s * dt_s;
  const double rotation_rad = twist.omega_rad_s * dt_s;
  const double left_m = (distance_m - rotation_rad * model.wheel_base_m / 2.0) * m.left_wheel_scale;
  const double right_m = (distance_m + rotation_rad * model.wheel_base_m / 2.0) * m.right_wheel_scale;
  const double measured_distance_m =
      0.5 * (left_m + right_m) + rng.normal(m.sigma_distance) * std::sqrt(std::abs(distance_m));
  const double measured_rotation_rad = (right_m - left_m) / (model.wheel_base_m * m.wheel_base_scale) +
                                       rng.normal(m.sigma_rotation) * std::sqrt(std::abs(rotation_rad)) +
                                       rng.normal(m.sigma_rotation_per_distance) * std::sqrt(std::abs(distance_m));
  odom_T_base_ = odom_T_base_ * integrate({measured_distance_m / dt_s, measured_rotation_rad / dt_s}, dt_s);
  // The board reports the filtered speed of the wheels, without the random part of one step.
  velocity_ = {0.5 * (left_m + right_m) / dt_s, (right_m - left_m) / (model.wheel_base_m * m.wheel_base_scale) / dt_s};
}

Walker::Walker(const PersonPath& path, std::uint64_t serial)
    : path_(path), paint_(make_paint(path.surface, serial)), position_(path.waypoints.front()) {}

void Walker::step(std::span<const Disc> robots, double dt_s) {
  const Point2 to_goal = path_.waypoints[next_] - position_;
  const double distance_m = path_.speed_m_s * dt_s;
  const double left_m = to_goal.norm();
  if (left_m <= distance_m) {
    position_ = path_.waypoints[next_];
    if (next_ + 1 == path_.waypoints.size()) {
      forward_ = false;
    } else if (next_ == 0) {
      forward_ = true;
    }
    next_ = forward_ ? next_ + 1 : next_ - 1;
    return;
  }
  const Point2 next = position_ + to_goal * (distance_m / left_m);
  const auto waits_for = [&](const Disc& robot) {
    const double gap_m = (next - robot.centre).norm() - robot.radius_m - path_.radius_m;
    return gap_m < path_.wait_m && (next - robot.centre).norm() < (position_ - robot.centre).norm();
  };
  if (std::none_of(robots.begin(), robots.end(), waits_for)) {
    position_ = next;
  }
}

}  // namespace seeker::sim
