/// \file
/// A device of the emulator as a state machine: the host's bytes and time in, the device's bytes out. It follows the
/// protocol of the real device, so that programs of others can be run against it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/core/time.hpp"

namespace seeker::emulator {

/// One device on one line. Times are those of the simulated world and never run backwards.
class EmulatedDevice {
 public:
  EmulatedDevice() = default;
  EmulatedDevice(const EmulatedDevice&) = delete;
  EmulatedDevice& operator=(const EmulatedDevice&) = delete;
  virtual ~EmulatedDevice() = default;

  /// The host sent these bytes, cut anywhere, at the rate that baud() gave.
  virtual void receive(std::span<const std::uint8_t> bytes, RobotTime now) = 0;
  /// Time has passed: the device measures, moves and sends.
  virtual void pass(RobotTime now) = 0;
  /// When pass() is wanted next.
  [[nodiscard]] virtual RobotTime wake() const = 0;
  /// Takes what the device has sent by now; its owner paces the bytes by the rate of the line.
  [[nodiscard]] virtual std::vector<std::uint8_t> take_output() = 0;
  /// The rate at which the device listens and sends; 0: the line has none (TCP).
  [[nodiscard]] virtual std::uint32_t baud() const = 0;
  /// Power was cut and is back: everything but what the device keeps in flash is as at first.
  virtual void power_cycle(RobotTime now) = 0;
};

}  // namespace seeker::emulator
