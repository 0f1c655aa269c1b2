/// \file
/// An emulated Pioneer base that speaks P2OS/ARCOS (protocols 1), for our own session and for the programs of others.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/core/time.hpp"
#include "server/emulator/devices/emulated_device.hpp"
#include "server/emulator/devices/p2os_device_params.hpp"
#include "server/emulator/devices/pioneer_body.hpp"
#include "server/emulator/devices/pioneer_counters.hpp"
#include "server/emulator/devices/pioneer_gyro.hpp"
#include "server/emulator/devices/pioneer_motion.hpp"
#include "server/protocols/p2os/command.hpp"
#include "server/protocols/p2os/timed_packet_reader.hpp"

namespace seeker::emulator {

/// The base answers a handshake, obeys commands and sends information. Its motors are off when a connection begins.
/// Without a valid packet for the watchdog interval it halts, and it goes on by itself when packets come again.
class P2osDevice final : public EmulatedDevice {
 public:
  /// `params` are valid, see validate(); power is on from `now` on.
  P2osDevice(P2osDeviceParams params, P2osDeviceHooks hooks, RobotTime now);

  void receive(std::span<const std::uint8_t> bytes, RobotTime now) override;
  void pass(RobotTime now) override;
  [[nodiscard]] RobotTime wake() const override;
  [[nodiscard]] std::vector<std::uint8_t> take_output() override;
  [[nodiscard]] std::uint32_t baud() const override { return baud_; }
  void power_cycle(RobotTime now) override;

  void set_faults(const P2osFaults& faults);

  /// A client is connected: information is sent.
  [[nodiscard]] bool connected() const { return step_ == Step::kOpen; }
  [[nodiscard]] bool motors_on() const { return motors_on_; }
  /// The watchdog holds the base.
  [[nodiscard]] bool watchdog_holds(RobotTime now) const { return now - last_valid_ >= params_.watchdog; }

 private:
  /// The packet that is expected next; kOpen: a connection.
  enum class Step : std::uint8_t { kSync0, kSync1, kSync2, kSynced, kOpen };
  enum class Repeat : std::uint8_t { kNever, kOnce, kAlways };

  void handle_packets(RobotTime now);
  void on_sync(const p2os::Packet& packet, RobotTime now);
  void on_command(const p2os::Command& command, RobotTime now);
  void on_service(const p2os::Command& command, RobotTime now);
  void open(RobotTime now);
  void disconnect();
  void enable(bool on);

  /// Measures the base and gives its motors their velocity.
  void control(RobotTime now);
  [[nodiscard]] PioneerMotion::Power power(RobotTime now) const;
  void send(const p2os::Packet& packet);
  void send_information(RobotTime now);
  void add_sonars(p2os::Sip& sip, RobotTime now);
  void send_encoders();

  const P2osDeviceParams params_;
  const P2osDeviceHooks hooks_;
  const p2os::PioneerModel& model_;
  p2os::TimedPacketReader reader_;
  std::vector<std::uint8_t> output_;
  PioneerMotion motion_;
  PioneerCounters counters_;
  PioneerGyro gyro_;
  PioneerBody body_;

  Step step_ = Step::kSync0;
  std::uint32_t baud_ = 0;
  bool motors_on_ = false;
  bool sonar_on_ = true;
  bool gyro_on_ = false;
  Repeat encoders_ = Repeat::kNever;
  int bump_stall_ = 0;
  std::size_t next_sonar_ = 0;
  RobotTime last_valid_;
  RobotTime last_control_;
  RobotTime next_information_;
};

}  // namespace seeker::emulator
