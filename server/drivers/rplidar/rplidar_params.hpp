/// \file
/// Settings of the driver for RPLIDAR A1 and A2.
#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

#include "common/core/angle.hpp"
#include "common/core/pose2.hpp"
#include "common/core/result.hpp"
#include "common/core/time.hpp"

namespace seeker::drivers {

/// How samples are sent. Automatic: in capsules where the device answers to that, else sample by sample.
enum class RplidarScanMode : std::uint8_t { kAutomatic, kExpress, kLegacy };
/// How the motor is switched. Automatic: by request where the accessory board says that it can, else by DTR.
enum class RplidarMotor : std::uint8_t { kAutomatic, kDtr, kPwm };

struct RplidarParams {
  /// Rates of the serial line, in the order in which they are tried.
  std::vector<std::uint32_t> bauds{115'200, 256'000};
  RplidarScanMode scan_mode = RplidarScanMode::kAutomatic;
  RplidarMotor motor = RplidarMotor::kAutomatic;
  std::uint16_t motor_pwm = 660;  ///< duty of 1023 for a motor that is switched by request
  Pose2 base_T_laser;             ///< the x axis of the laser points to the device's front mark
  bool upside_down = false;       ///< mounted with its top down: it turns counter-clockwise then
  double range_min_m = 0.15;
  double range_max_m = 12.0;
  double angle_step_rad = deg_to_rad(1.0);  ///< of the scans; rounded so that a turn has a whole number of beams
  double least_revolution_share = 0.75;     ///< a turn of which less was received is not delivered
  Duration answer_timeout = std::chrono::milliseconds(500);
  int tries = 3;                                          ///< of a request before it counts as unanswered
  Duration stop_pause = std::chrono::milliseconds(100);   ///< from STOP to the next request
  Duration boot_time = std::chrono::seconds(2);           ///< from RESET to the next request
  Duration scan_timeout = std::chrono::seconds(1);        ///< silence after which the scan is started again
  Duration revolution_timeout = std::chrono::seconds(5);  ///< without a whole turn: the rotor is blocked, or worse
  int restarts = 3;                                       ///< of the scan in a row before the line is given up
  int resets = 2;                                         ///< of a device in protection stop before it is given up
};

/// Refuses settings that no device can have, naming the field.
[[nodiscard]] Status validate(const RplidarParams& params);

}  // namespace seeker::drivers
