/// \file
/// The motion control of a Pioneer's firmware: which velocity its motors are given (protocols 1.4).
#pragma once

#include <cstdint>

#include "common/core/angle.hpp"
#include "common/core/pose2.hpp"
#include "common/core/time.hpp"

namespace seeker::emulator {

struct PioneerLimits {
  double v_max_m_s = 0.75;
  double omega_max_rad_s = deg_to_rad(100.0);
  double acceleration_m_s2 = 0.3;
  double deceleration_m_s2 = 0.3;
  double angular_acceleration_rad_s2 = deg_to_rad(100.0);
  double angular_deceleration_rad_s2 = deg_to_rad(100.0);
};

/// Translation and rotation are commanded apart from each other, each by a velocity or by an aim; the velocity of both
/// wheels (VEL2) takes the place of both.
class PioneerMotion {
 public:
  /// What the motors may do.
  enum class Power : std::uint8_t {
    kFull,
    kHold,  ///< brakes and keeps what was commanded, to resume it later
    kOff,   ///< nothing turns; what was commanded is kept
  };

  explicit PioneerMotion(const PioneerLimits& limits) : limits_(limits) {}

  [[nodiscard]] PioneerLimits& limits() { return limits_; }

  void set_velocity(double v_m_s);
  void set_rotation(double omega_rad_s);
  void set_both(const Twist2& velocity);
  /// Drives this far from here, backwards if negative.
  void move(double distance_m);
  /// Turns to a heading of the odometry, in the shorter direction.
  void rotate_to(double theta_rad);
  /// Brakes to a halt; an aim is given up.
  void stop();
  /// Halts without the deceleration; an aim is given up.
  void halt();

  /// The odometry was set to zero, which is no motion.
  void zero_odometry() { last_ = {}; }

  /// Velocity for the motors after `dt_s` more; `odom_T_base` is the pose now.
  Twist2 step(const Pose2& odom_T_base, double dt_s, Power power);
  /// Whether it was commanded to move.
  [[nodiscard]] bool wants_to_move() const;
  /// Commanded translation: +1 forwards, -1 backwards, 0 none.
  [[nodiscard]] int direction() const;
  /// Heading that is aimed at; the present one if none is.
  [[nodiscard]] double heading_rad(const Pose2& odom_T_base) const {
    return turning_ ? aim_rad_ : odom_T_base.theta_rad;
  }

 private:
  void leave_wheels();
  [[nodiscard]] double wanted_v_m_s(const Pose2& odom_T_base);
  [[nodiscard]] double wanted_omega_rad_s(const Pose2& odom_T_base);

  PioneerLimits limits_;
  Twist2 wanted_;
  bool both_ = false;     ///< commanded by VEL2
  bool moving_ = false;   ///< a distance is left
  bool turning_ = false;  ///< a heading is aimed at
  double left_m_ = 0.0;
  double aim_rad_ = 0.0;
  Pose2 last_;
  Twist2 present_;
};

}  // namespace seeker::emulator
