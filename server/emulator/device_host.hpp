/// \file
/// The emulated devices of a world on their lines, with the faults that are commanded.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/core/result.hpp"
#include "common/core/rng.hpp"
#include "common/core/time.hpp"
#include "server/emulator/device_line.hpp"
#include "server/emulator/devices/emulated_device.hpp"
#include "server/emulator/fault_command.hpp"
#include "server/emulator/line_noise.hpp"

namespace seeker::emulator {

/// A device and where hosts find it.
struct HostedDevice {
  std::string name;  ///< as fault commands call it
  std::unique_ptr<EmulatedDevice> device;
  std::unique_ptr<DeviceLine> line;
  /// Faults of the device itself, by name, switched on or off. kNotFound lists those that there are.
  std::function<Status(const std::string& fault, bool on)> inject;
};

/// Carries bytes between devices and hosts at the rate of each line, after every step of the world.
class DeviceHost {
 public:
  /// `seed` is of the places where bit errors and losses fall.
  DeviceHost(std::vector<HostedDevice> devices, std::uint64_t seed);

  /// Lets hosts reach all devices. Errors are those of DeviceLine::plug().
  [[nodiscard]] Status plug();
  /// Takes a fault for its time. kNotFound lists the devices, or the faults of the device.
  [[nodiscard]] Status add(FaultCommand command);
  /// The world has come to `now`.
  void step(RobotTime now);
  /// Name and address of each device, one a line.
  [[nodiscard]] std::string addresses() const;

 private:
  struct Hosted {
    HostedDevice parts;
    LineNoise to_device;
    LineNoise to_host;
    LineFaults faults;
    std::deque<std::uint8_t> sent;  ///< not arrived yet: it goes at the rate of the line
    double credit_bytes = 0.0;      ///< what the line may carry now
    bool plugged = false;
  };
  struct Switch {
    RobotTime at;
    FaultCommand command;
    bool on = true;
  };

  [[nodiscard]] Hosted* find(const std::string& name);
  void apply_due(RobotTime now);
  [[nodiscard]] static Status apply(Hosted& hosted, const FaultCommand& command, bool on, RobotTime now);
  static void carry(Hosted& hosted, Duration period, RobotTime now);

  std::vector<Hosted> devices_;
  std::vector<Switch> switches_;
  RobotTime now_;
};

}  // namespace seeker::emulator
