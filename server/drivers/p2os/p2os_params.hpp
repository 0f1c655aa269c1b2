/// \file
/// How a Pioneer base is connected and driven.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/core/angle.hpp"
#include "common/core/result.hpp"
#include "common/core/time.hpp"

namespace seeker::drivers {

struct P2osParams {
  bool serial = true;  ///< a serial line, whose rate is searched; otherwise TCP
  /// Rates at which the base is searched, in this order.
  std::vector<std::uint32_t> bauds{9600, 38400, 19200, 115200, 57600};
  /// Rate to switch to where the base allows it (protocols 1.1). Nothing: the rate at which it was found stays.
  std::optional<std::uint32_t> switch_to_baud;
  /// Model to assume regardless of the subclass that the base names, for a base with an unknown one.
  std::optional<std::string> subclass;

  double v_max_m_s = 0.5;
  double omega_max_rad_s = deg_to_rad(90.0);
  double acceleration_m_s2 = 0.3;
  double deceleration_m_s2 = 0.6;
  double angular_acceleration_rad_s2 = deg_to_rad(100.0);
  double angular_deceleration_rad_s2 = deg_to_rad(100.0);

  bool use_sonar = true;
  bool use_gyro = true;            ///< turns by the gyroscope where the base has one
  bool use_bumpers = true;         ///< a pressed bumper stops the base
  bool use_vel2 = false;           ///< commands the wheels (VEL2, steps of 20 mm/s) instead of VEL and RVEL
  double sonar_range_max_m = 5.0;  ///< readings from here on are no return
  double sonar_cone_half_angle_rad = deg_to_rad(15.0);
  Duration sonar_max_age = std::chrono::seconds(1);  ///< readings older than this are left out of a scan

  Duration pulse_period = std::chrono::milliseconds(400);     ///< of PULSE while the control loop is alive
  Duration velocity_resend = std::chrono::milliseconds(250);  ///< a velocity is repeated while the base moves
  Duration command_timeout = std::chrono::milliseconds(500);  ///< without a newer velocity the base is stopped
  Duration sip_timeout = std::chrono::milliseconds(500);      ///< without information from the base the link is lost

  int sync_tries = 3;                                       ///< at each rate
  Duration sync_timeout = std::chrono::seconds(1);          ///< for each step of the handshake
  Duration restart_pause = std::chrono::milliseconds(100);  ///< before the handshake begins again
  Duration close_settle = std::chrono::milliseconds(400);   ///< for an old connection to end after CLOSE
  Duration open_timeout = std::chrono::seconds(2);          ///< from OPEN to the first information
  Duration config_retry = std::chrono::milliseconds(200);
  Duration config_timeout = std::chrono::seconds(1);  ///< without configuration the model's limits hold
  Duration baud_settle = std::chrono::milliseconds(10);
  Duration baud_timeout = std::chrono::milliseconds(900);  ///< for a sign of life at the new rate

  /// What a step of the odometry may be longer and turn more than the fastest motion since the step before it; longer
  /// ones are dropped.
  double step_margin_m = 0.05;
  double step_margin_rad = deg_to_rad(10.0);
};

/// Refuses values with which no base can be driven, with their names.
[[nodiscard]] Status validate(const P2osParams& params);

}  // namespace seeker::drivers
