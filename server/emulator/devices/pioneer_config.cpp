#include "server/emulator/devices/pioneer_config.hpp"

#include <cmath>

#include "common/core/angle.hpp"
#include "server/protocols/p2os/command.hpp"
#include "server/protocols/p2os/pioneer_model.hpp"

namespace seeker::emulator {
namespace {

/// What a Pioneer's hardware reaches, and its usual settings.
constexpr std::uint16_t kRotAccTop_deg_s2 = 600;
constexpr std::uint16_t kTransAccTop_mm_s2 = 4000;
constexpr std::uint16_t kPwmMax = 500;
constexpr std::uint16_t kLowBattery_dv = 115;
constexpr std::uint16_t kShutdown_dv = 105;
constexpr std::uint8_t kSonarCycle_ms = 40;
constexpr std::uint8_t kBumpersInARow = 5;
constexpr std::uint16_t kRevCount = 16570;
constexpr std::uint16_t kStallVal = 200;
constexpr std::uint16_t kStallCount = 100;

std::uint16_t whole(double value) { return static_cast<std::uint16_t>(std::lround(value)); }
std::uint16_t mm(double value_m) { return whole(value_m / p2os::kMetre); }
std::uint16_t deg(double value_rad) { return whole(rad_to_deg(value_rad)); }
std::uint16_t ms(Duration value) { return whole(1e3 * to_seconds(value)); }

void set_motion(p2os::ConfigPacket& config, const P2osDeviceParams& params) {
  config.rot_vel_top = deg(params.omega_top_rad_s);
  config.trans_vel_top = mm(params.v_top_m_s);
  config.rot_acc_top = kRotAccTop_deg_s2;
  config.trans_acc_top = kTransAccTop_mm_s2;
  config.rot_vel_max = deg(params.limits.omega_max_rad_s);
  config.trans_vel_max = mm(params.limits.v_max_m_s);
  config.rot_acc = deg(params.limits.angular_acceleration_rad_s2);
  config.rot_decel = deg(params.limits.angular_deceleration_rad_s2);
  config.trans_acc = mm(params.limits.acceleration_m_s2);
  config.trans_decel = mm(params.limits.deceleration_m_s2);
}

void set_equipment(p2os::ConfigPacket& config, const P2osDeviceParams& params) {
  config.front_bumps = params.has_front_bumpers ? kBumpersInARow : std::uint8_t{0};
  config.rear_bumps = params.has_rear_bumpers ? kBumpersInARow : std::uint8_t{0};
  config.charger = 0;
  config.sonar_cycle_ms = kSonarCycle_ms;
  config.auto_baud = params.baud_may_change ? p2os::kBaudMayChange : std::uint8_t{0};
  config.has_gyro = params.has_gyro ? p2os::kGyroSendsPackets : std::uint8_t{0};
  config.drift_factor = 0;
  config.aux2_baud = config.aux3_baud = 0;
  config.ticks_mm = kTicksPerMm;
  config.shutdown_dv = kShutdown_dv;
  config.firmware_version = "2.9";
}

}  // namespace

p2os::ConfigPacket config_of(const P2osDeviceParams& params) {
  p2os::ConfigPacket config;
  config.type = "Pioneer";
  config.subtype = params.subclass;
  config.serial_number = params.serial_number;
  config.pwm_max = kPwmMax;
  config.name = params.name;
  config.sip_cycle_ms = static_cast<std::uint8_t>(ms(params.sip_period));
  config.host_baud = static_cast<std::uint8_t>(p2os::baud_code(params.baud).value_or(0));
  config.front_sonar = 1;
  config.low_battery_dv = kLowBattery_dv;
  config.rev_count = kRevCount;
  config.watchdog_ms = ms(params.watchdog);
  config.stall_val = kStallVal;
  config.stall_count = kStallCount;
  set_motion(config, params);
  set_equipment(config, params);
  return config;
}

}  // namespace seeker::emulator
