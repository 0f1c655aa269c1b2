#include <gtest/gtest.h>

#include "server/protocols/p2os/config_packet.hpp"
#include "server/protocols/p2os/field_reader.hpp"

namespace seeker::p2os {
namespace {

ConfigPacket full_config() {
  ConfigPacket config;
  config.type = "Pioneer", config.subtype = "p3dx-sh", config.serial_number = "ABC1", config.four_motors = 1;
  config.rot_vel_top = 360, config.trans_vel_top = 1500, config.rot_acc_top = 600, config.trans_acc_top = 4000;
  config.pwm_max = 500, config.name = "Emu", config.sip_cycle_ms = 100, config.host_baud = 0;
  config.front_sonar = 1, config.rear_sonar = 1, config.low_battery_dv = 110, config.watchdog_ms = 2000;
  config.rot_vel_max = 100, config.trans_vel_max = 750, config.rot_acc = 100, config.rot_decel = 101;
  config.rot_kp = 40, config.rot_kv = 20, config.trans_acc = 300, config.trans_decel = 301, config.trans_ki = 9;
  config.front_bumps = 5, config.rear_bumps = 6, config.charger = 0, config.sonar_cycle_ms = 40;
  config.auto_baud = kBaudMayChange, config.has_gyro = kGyroSendsPackets, config.drift_factor = -3;
  config.aux2_baud = 0, config.aux3_baud = 0, config.ticks_mm = 138, config.shutdown_dv = 105;
  config.firmware_version = "2.9", config.gyro_cw = 1, config.gyro_ccw = 2, config.kinematics_delay_ms = 3;
  config.lat_vel_top = 4, config.lat_acc_top = 5, config.lat_vel_max = 6, config.lat_acc = 7, config.lat_decel = 8;
  config.charge_threshold = 9, config.pdb_port = 10, config.gyro_rate_limit = 11, config.high_temperature_c = -12;
  config.power_bits = 13, config.battery_type = 14, config.charge_low_percent = 15;
  config.charge_shutdown_percent = 16, config.boot_version = "1.0", config.config_flags = 0x12345678;
  config.gyro_firmware = -17;
  return config;
}

TEST(P2osConfigPacket, AFullConfigurationComesBack) {
  const auto config = read_config(write_config(full_config()));
  ASSERT_TRUE(config);
  EXPECT_EQ(*config, full_config());
}

TEST(P2osConfigPacket, TheFirstFieldsStandInTheOrderOfTheManual) {
  const Packet packet = write_config(full_config());
  EXPECT_TRUE(packet.is(PacketId::kConfig));
  FieldReader in(packet.data);
  EXPECT_EQ(in.text(), "Pioneer");
  EXPECT_EQ(in.text(), "p3dx-sh");
  EXPECT_EQ(in.text(), "ABC1");
  EXPECT_EQ(in.u8(), 1);
  EXPECT_EQ(in.u16(), 360);
  EXPECT_EQ(in.u16(), 1500);
  EXPECT_EQ(in.u16(), 600);
  EXPECT_EQ(in.u16(), 4000);
  EXPECT_EQ(in.u16(), 500);
  EXPECT_EQ(in.text(), "Emu");
  EXPECT_EQ(in.u8(), 100);
}

TEST(P2osConfigPacket, TheLastFieldsMayBeMissing) {
  Packet packet = write_config(full_config());
  packet.data.resize(packet.data.size() - 7);
  const auto config = read_config(packet);
  ASSERT_TRUE(config);
  EXPECT_EQ(config->charge_shutdown_percent, 16);
  EXPECT_FALSE(config->config_flags);
  EXPECT_FALSE(config->gyro_firmware);
}

TEST(P2osConfigPacket, AFieldAfterAMissingOneIsNotWritten) {
  ConfigPacket config = full_config();
  config.charger.reset();
  const auto read = read_config(write_config(config));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->rear_bumps, 6);
  EXPECT_FALSE(read->sonar_cycle_ms);
}

TEST(P2osConfigPacket, EachCutWithinTheGainsIsCorruptAndAnyOtherIsNot) {
  const Packet packet = write_config(full_config());
  std::size_t corrupt = 0;
  for (std::size_t bytes = 0; bytes < packet.data.size(); ++bytes) {
    Packet cut = packet;
    cut.data.resize(bytes);
    const auto config = read_config(cut);
    corrupt += config ? 0U : 1U;
    EXPECT_TRUE(config || config.error().code == Errc::kCorrupt);
  }
  ConfigPacket shortest = full_config();
  shortest.front_bumps.reset();
  EXPECT_EQ(corrupt, write_config(shortest).data.size());
}

}  // namespace
}  // namespace seeker::p2os
