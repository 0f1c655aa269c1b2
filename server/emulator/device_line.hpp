/// \file
/// The emulator's end of the line to a device: a pseudo-terminal or a TCP port.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/core/result.hpp"

namespace seeker::emulator {

/// All calls return at once.
class DeviceLine {
 public:
  DeviceLine() = default;
  DeviceLine(const DeviceLine&) = delete;
  DeviceLine& operator=(const DeviceLine&) = delete;
  virtual ~DeviceLine() = default;

  /// Lets hosts reach the device. Errors are kIo.
  [[nodiscard]] virtual Status plug() = 0;
  /// Takes the device away: a host that uses it sees its line end.
  virtual void unplug() = 0;
  /// What the host has sent since the last call; empty where there is no host.
  [[nodiscard]] virtual std::vector<std::uint8_t> receive() = 0;
  /// Sends to the host; what it does not take is lost, as on a real line.
  virtual void send(std::span<const std::uint8_t> bytes) = 0;
  /// The rate that the host has chosen; 0: the line has none.
  [[nodiscard]] virtual std::uint32_t host_baud() const = 0;
  /// Where hosts find the device, as robot files name it.
  [[nodiscard]] virtual std::string address() const = 0;
};

}  // namespace seeker::emulator
