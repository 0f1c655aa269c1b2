#include "server/drivers/p2os/base_odometry.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/angle.hpp"

namespace seeker::drivers {
namespace {

/// The rotation of the last step in motion is corrected in the first packet at rest, so that the base stands for the
/// gyroscope only from the second one on.
constexpr int kPacketsAtRest = 2;

/// Shortest difference of two counters that wrap.
int difference(int to, int from) {
  const int d = (to - from) & (p2os::kPositionModulus - 1);
  return d >= p2os::kPositionModulus / 2 ? d - p2os::kPositionModulus : d;
}

}  // namespace

void BaseOdometry::connect(const p2os::PioneerModel& model, Duration sip_cycle) {
  model_ = &model;
  sip_cycle_ = sip_cycle;
  gyro_.emplace(p2os::gyro_rad_s_per_count(model.gyro_scaler));
  last_.reset();
  doubtful_.reset();
  velocity_ = {};
  packets_at_rest_ = 0;
  last_rotation_rad_ = 0.0;
  last_passed_ = Duration{0};
}

void BaseOdometry::add(std::span<const p2os::GyroReading> readings) {
  if (params_.use_gyro && gyro_) {
    gyro_->add(readings, packets_at_rest_ >= kPacketsAtRest);
  }
}

Pose2 BaseOdometry::step_between(const Counters& from, const Counters& to) const {
  const double dx_m = difference(to.x, from.x) * model_->distance_unit_m;
  const double dy_m = difference(to.y, from.y) * model_->distance_unit_m;
  const double theta_rad = from.theta * p2os::kAngleUnit_rad;
  return {dx_m * std::cos(theta_rad) + dy_m * std::sin(theta_rad),
          dy_m * std::cos(theta_rad) - dx_m * std::sin(theta_rad),
          wrap_angle((to.theta - from.theta) * p2os::kAngleUnit_rad)};
}

bool BaseOdometry::possible(const Pose2& step, Duration passed) const {
  // Packets that waited somewhere arrive at the same time.
  const double passed_s = to_seconds(std::max(passed, sip_cycle_));
  return std::hypot(step.x_m, step.y_m) <= model_->v_max_m_s * passed_s + params_.step_margin_m &&
         std::abs(step.theta_rad) <= model_->omega_max_rad_s * passed_s + params_.step_margin_rad;
}

double BaseOdometry::gyro_correction_rad() {
  const std::optional<double> rotation_rad = gyro_->take_rotation_rad(last_passed_);
  return rotation_rad && packets_at_rest_ < kPacketsAtRest ? *rotation_rad - last_rotation_rad_ : 0.0;
}

void BaseOdometry::go(const Pose2& step, Duration passed) {
  odom_T_base_ = odom_T_base_ * Pose2{0.0, 0.0, gyro_correction_rad()} * step;
  last_rotation_rad_ = step.theta_rad;
  last_passed_ = passed;
}

void BaseOdometry::measure_velocity(const p2os::Sip& sip, const Pose2& step) {
  const double left_m_s = sip.left_velocity * model_->velocity_unit_m_s;
  const double right_m_s = sip.right_velocity * model_->velocity_unit_m_s;
  velocity_.v_m_s = (left_m_s + right_m_s) / 2.0;
  constexpr double kTenthDegree = 0.1;
  velocity_.omega_rad_s = sip.rotational_velocity ? deg_to_rad(*sip.rotational_velocity * kTenthDegree)
                                                  : (right_m_s - left_m_s) / 2.0 * model_->rotation_rad_per_m;
  const bool at_rest = sip.left_velocity == 0 && sip.right_velocity == 0 && step == Pose2{};
  packets_at_rest_ = at_rest ? std::min(packets_at_rest_ + 1, kPacketsAtRest) : 0;
}

bool BaseOdometry::add(const p2os::Sip& sip, RobotTime stamp) {
  const Counters now{sip.x, sip.y, sip.theta, stamp};
  if (!last_) {
    last_ = now;
    measure_velocity(sip, {});
    return true;
  }
  const Counters* from = &*last_;
  if (!possible(step_between(*from, now), now.stamp - from->stamp)) {
    if (!doubtful_ || !possible(step_between(*doubtful_, now), now.stamp - doubtful_->stamp)) {
      doubtful_ = now;
      ++dropped_steps_;
      return false;
    }
    from = &*doubtful_;
  }
  const Pose2 step = step_between(*from, now);
  measure_velocity(sip, step);
  go(step, now.stamp - from->stamp);
  last_ = now;
  doubtful_.reset();
  return true;
}

}  // namespace seeker::drivers
