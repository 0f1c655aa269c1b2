#include "server/protocols/p2os/config_packet.hpp"

#include "server/protocols/p2os/field_io.hpp"

namespace seeker::p2os {
namespace {

/// Calls `visit` for each field of every firmware, in the order of the wire.
template <class C, class Visit>
void for_each_early_field(C& c, Visit&& visit) {
  visit(c.type), visit(c.subtype), visit(c.serial_number), visit(c.four_motors);
  visit(c.rot_vel_top), visit(c.trans_vel_top), visit(c.rot_acc_top), visit(c.trans_acc_top);
  visit(c.pwm_max), visit(c.name), visit(c.sip_cycle_ms), visit(c.host_baud), visit(c.aux1_baud);
  visit(c.gripper), visit(c.front_sonar), visit(c.rear_sonar), visit(c.low_battery_dv);
  visit(c.rev_count), visit(c.watchdog_ms), visit(c.p2_mpacs), visit(c.stall_val), visit(c.stall_count);
  visit(c.joy_vel), visit(c.joy_rot_vel), visit(c.rot_vel_max), visit(c.trans_vel_max);
  visit(c.rot_acc), visit(c.rot_decel), visit(c.rot_kp), visit(c.rot_kv), visit(c.rot_ki);
  visit(c.trans_acc), visit(c.trans_decel), visit(c.trans_kp), visit(c.trans_kv), visit(c.trans_ki);
}

/// Calls `visit` for each field after those, in the order of the wire.
template <class C, class Visit>
void for_each_later_field(C& c, Visit&& visit) {
  visit(c.front_bumps), visit(c.rear_bumps), visit(c.charger), visit(c.sonar_cycle_ms), visit(c.auto_baud);
  visit(c.has_gyro), visit(c.drift_factor), visit(c.aux2_baud), visit(c.aux3_baud), visit(c.ticks_mm);
  visit(c.shutdown_dv), visit(c.firmware_version), visit(c.gyro_cw), visit(c.gyro_ccw);
  visit(c.kinematics_delay_ms), visit(c.lat_vel_top), visit(c.lat_acc_top), visit(c.lat_vel_max);
  visit(c.lat_acc), visit(c.lat_decel), visit(c.charge_threshold), visit(c.pdb_port);
  visit(c.gyro_rate_limit), visit(c.high_temperature_c), visit(c.power_bits), visit(c.battery_type);
  visit(c.charge_low_percent), visit(c.charge_shutdown_percent), visit(c.boot_version);
  visit(c.config_flags), visit(c.gyro_firmware);
}

}  // namespace

Result<ConfigPacket> read_config(const Packet& packet) {
  ConfigPacket config;
  FieldReader in(packet.data);
  bool complete = true;
  for_each_early_field(config, [&]<class T>(T& field) {
    if (const auto value = read_field<T>(in)) {
      field = *value;
    } else {
      complete = false;
    }
  });
  if (!complete) {
    return fail(Errc::kCorrupt, "the base's configuration ends after " + std::to_string(packet.data.size()) +
                                    " bytes, before its last gain");
  }
  for_each_later_field(config, [&]<class T>(std::optional<T>& field) { field = read_field<T>(in); });
  return config;
}

Packet write_config(const ConfigPacket& config) {
  FieldWriter out;
  for_each_early_field(config, [&](const auto& field) { write_field(out, field); });
  bool complete = true;
  for_each_later_field(config, [&](const auto& field) {
    complete = complete && field.has_value();
    if (complete) {
      write_field(out, *field);
    }
  });
  return {static_cast<std::uint8_t>(PacketId::kConfig), out.take()};
}

}  // namespace seeker::p2os
