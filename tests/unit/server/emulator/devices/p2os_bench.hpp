/// \file
/// An emulated Pioneer base on blocks: a robot without inertia or errors follows its commands on a clock that the test
/// turns.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "common/core/pose2.hpp"
#include "common/core/time.hpp"
#include "server/emulator/devices/p2os_device.hpp"
#include "server/protocols/p2os/packet_reader.hpp"
#include "server/protocols/p2os/sip.hpp"

namespace seeker::emulator {

class P2osBench {
 public:
  static constexpr Duration kStep = std::chrono::milliseconds(10);

  explicit P2osBench(P2osDeviceParams params = {}) : device(std::move(params), hooks(), now) {}

  /// The robot moves and the base works for this long, in steps of kStep.
  void pass(Duration duration) {
    for (const RobotTime end = now + duration; now < end;) {
      now += kStep;
      world ? world() : follow();
      device.pass(now);
    }
  }
  void say(const std::vector<std::uint8_t>& bytes) { device.receive(bytes, now); }
  /// The packets that the base has sent since the last call.
  std::vector<p2os::Packet> heard() {
    reader_.feed(device.take_output());
    std::vector<p2os::Packet> packets;
    while (auto packet = reader_.next()) {
      packets.push_back(std::move(*packet));
    }
    return packets;
  }
  /// The newest information, of the last 100 ms and more.
  p2os::Sip information() {
    pass(std::chrono::milliseconds(100));
    p2os::Sip newest;
    for (const p2os::Packet& packet : heard()) {
      if (p2os::is_sip(packet)) {
        newest = p2os::read_sip(packet).value();
      }
    }
    return newest;
  }
  /// The handshake, and motors on if wanted.
  void connect(bool motors = true) {
    using p2os::CommandId;
    for (const CommandId id : {CommandId::kPulse, CommandId::kOpen, CommandId::kClose, CommandId::kOpen}) {
      say(p2os::encode_command(id));
    }
    if (motors) {
      say(p2os::encode_command(CommandId::kEnable, 1));
    }
    heard();
  }

  RobotTime now = robot_time_s(5.0);
  Twist2 commanded;
  sim::BaseReading reading{Pose2{}, Twist2{}, 12.6, false, false};
  SonarScan sonar;
  std::optional<double> contact_bearing_rad;
  bool blocked = false;
  std::function<void()> world;  ///< moves the robot for kStep and sets what it reads, in place of the blocks
  P2osDevice device;

 private:
  void follow() {
    reading.velocity = blocked ? Twist2{} : commanded;
    reading.stalled = blocked && !(commanded == Twist2{});
    reading.odom_T_base = reading.odom_T_base * integrate(reading.velocity, to_seconds(kStep));
  }
  P2osDeviceHooks hooks() {
    return {[this](RobotTime) { return reading; }, [this](RobotTime) { return sonar; },
            [this](const Twist2& twist) { commanded = twist; }, [this] { return contact_bearing_rad; }};
  }

  p2os::PacketReader reader_;
};

}  // namespace seeker::emulator
