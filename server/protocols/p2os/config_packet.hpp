/// \file
/// The packet in which a base reports its configuration (protocols 1.7), in the units of the wire.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/core/result.hpp"
#include "server/protocols/p2os/packet.hpp"

namespace seeker::p2os {

/// Value of ConfigPacket::auto_baud with which a client may change the rate of the line.
inline constexpr std::uint8_t kBaudMayChange = 2;
/// Value of ConfigPacket::has_gyro of a base that sends gyroscope packets.
inline constexpr std::uint8_t kGyroSendsPackets = 1;

/// The fields in the order of the wire. Velocities are mm/s and deg/s, accelerations mm/s^2 and deg/s^2; `top` is what
/// the hardware reaches, `max` what is set. Old firmware stops after the gains; where a field is missing, all after it
/// are missing as well.
struct ConfigPacket {
  std::string type;
  std::string subtype;
  std::string serial_number;
  std::uint8_t four_motors = 0;
  std::uint16_t rot_vel_top = 0;
  std::uint16_t trans_vel_top = 0;
  std::uint16_t rot_acc_top = 0;
  std::uint16_t trans_acc_top = 0;
  std::uint16_t pwm_max = 0;
  std::string name;
  std::uint8_t sip_cycle_ms = 0;
  std::uint8_t host_baud = 0;  ///< see baud_of_code()
  std::uint8_t aux1_baud = 0;
  std::uint16_t gripper = 0;
  std::uint16_t front_sonar = 0;
  std::uint8_t rear_sonar = 0;
  std::uint16_t low_battery_dv = 0;
  std::uint16_t rev_count = 0;
  std::uint16_t watchdog_ms = 0;
  std::uint8_t p2_mpacs = 0;
  std::uint16_t stall_val = 0;
  std::uint16_t stall_count = 0;
  std::uint16_t joy_vel = 0;
  std::uint16_t joy_rot_vel = 0;
  std::uint16_t rot_vel_max = 0;
  std::uint16_t trans_vel_max = 0;
  std::uint16_t rot_acc = 0;
  std::uint16_t rot_decel = 0;
  std::uint16_t rot_kp = 0;
  std::uint16_t rot_kv = 0;
  std::uint16_t rot_ki = 0;
  std::uint16_t trans_acc = 0;
  std::uint16_t trans_decel = 0;
  std::uint16_t trans_kp = 0;
  std::uint16_t trans_kv = 0;
  std::uint16_t trans_ki = 0;
  std::optional<std::uint8_t> front_bumps;  ///< number of bumpers
  std::optional<std::uint8_t> rear_bumps;
  std::optional<std::uint8_t> charger;
  std::optional<std::uint8_t> sonar_cycle_ms;
  std::optional<std::uint8_t> auto_baud;
  std::optional<std::uint8_t> has_gyro;
  std::optional<std::int16_t> drift_factor;
  std::optional<std::uint8_t> aux2_baud;
  std::optional<std::uint8_t> aux3_baud;
  std::optional<std::uint16_t> ticks_mm;
  std::optional<std::uint16_t> shutdown_dv;
  std::optional<std::string> firmware_version;
  std::optional<std::uint16_t> gyro_cw;
  std::optional<std::uint16_t> gyro_ccw;
  std::optional<std::uint8_t> kinematics_delay_ms;
  std::optional<std::uint16_t> lat_vel_top;
  std::optional<std::uint16_t> lat_acc_top;
  std::optional<std::uint16_t> lat_vel_max;
  std::optional<std::uint16_t> lat_acc;
  std::optional<std::uint16_t> lat_decel;
  std::optional<std::uint16_t> charge_threshold;
  std::optional<std::uint8_t> pdb_port;
  std::optional<std::uint16_t> gyro_rate_limit;
  std::optional<std::int8_t> high_temperature_c;
  std::optional<std::uint16_t> power_bits;
  std::optional<std::uint8_t> battery_type;
  std::optional<std::uint16_t> charge_low_percent;
  std::optional<std::uint16_t> charge_shutdown_percent;
  std::optional<std::string> boot_version;
  std::optional<std::uint32_t> config_flags;
  std::optional<std::int16_t> gyro_firmware;

  friend bool operator==(const ConfigPacket&, const ConfigPacket&) = default;
};

/// kCorrupt: it ends before its last gain, the fields that every firmware sends.
[[nodiscard]] Result<ConfigPacket> read_config(const Packet& packet);
/// The packet up to the first missing field; the texts are short enough for kMaxDataBytes in all.
[[nodiscard]] Packet write_config(const ConfigPacket& config);

}  // namespace seeker::p2os
