/// \file
/// Properties of an emulated Pioneer base, and its ties to the simulated robot.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "common/core/angle.hpp"
#include "common/core/pose2.hpp"
#include "common/core/result.hpp"
#include "common/core/scan.hpp"
#include "common/core/time.hpp"
#include "server/emulator/devices/pioneer_motion.hpp"
#include "server/protocols/p2os/gyro_packet.hpp"
#include "server/sim/robot_in_world.hpp"

namespace seeker::emulator {

/// What the base keeps in its flash memory, and its build.
struct P2osDeviceParams {
  std::string name = "Seeker";
  std::string subclass = "p3dx-sh";
  std::string serial_number = "0000";
  std::uint32_t baud = 9600;     ///< of the line after power-on and after each connection; 0: TCP
  bool baud_may_change = false;  ///< what its configuration says; HOSTBAUD is obeyed anyway, as the real base does
  Duration sip_period = std::chrono::milliseconds(100);
  Duration watchdog = std::chrono::seconds(2);    ///< without a command the base halts
  Duration stall_wait = std::chrono::seconds(1);  ///< a stalled wheel is without power for this long
  bool has_front_bumpers = true;
  bool has_rear_bumpers = true;
  bool has_gyro = false;
  double gyro_rest_count = p2os::kGyroCentreCount;
  std::size_t sonars_per_sip = 3;  ///< transducers are polled in turn
  /// Fastest velocity that can be set. Clients take steps above 0.1 m between two packets for damage (protocols 1.6).
  double v_top_m_s = 0.9;
  double omega_top_rad_s = deg_to_rad(300.0);
  PioneerLimits limits{};  ///< until a client sets others
};

/// Refuses properties that no base can have, with their names.
[[nodiscard]] Status validate(const P2osDeviceParams& params);

/// Ties to the simulated robot. All but the contact must be there.
struct P2osDeviceHooks {
  std::function<sim::BaseReading(RobotTime)> read_base;
  std::function<SonarScan(RobotTime)> read_sonar;
  std::function<void(const Twist2&)> command;
  /// Bearing of the obstacle that the body touches, in its own frame. Without it the base assumes the obstacle where it
  /// was going.
  std::function<std::optional<double>()> contact_bearing_rad;
};

/// Defects and hands that a test or a user lays on the base.
struct P2osFaults {
  bool left_wheel_stuck = false;
  bool right_wheel_stuck = false;
  bool e_stop_pressed = false;
  bool charger_plugged = false;
  bool silent = false;                ///< sends nothing, as with a cut cable
  std::uint8_t front_bumpers = 0;     ///< pressed ones, bits 1 to 5
  std::uint8_t rear_bumpers = 0;      ///< likewise
  std::optional<double> battery_v{};  ///< instead of that of the simulated robot
};

}  // namespace seeker::emulator
