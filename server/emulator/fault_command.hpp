/// \file
/// Faults of emulated devices on command.
#pragma once

#include <string>
#include <string_view>

#include "common/core/result.hpp"
#include "common/core/time.hpp"

namespace seeker::emulator {

/// One fault of one device.
struct FaultCommand {
  RobotTime at;         ///< when it begins, in the world's time
  std::string device;   ///< its name, such as "p2os"
  std::string fault;    ///< such as "unplug"; the device host lists them
  double value = 0.0;   ///< of a rate; other faults have none
  Duration duration{};  ///< zero: it stays

  friend bool operator==(const FaultCommand&, const FaultCommand&) = default;
};

/// Reads "AT_S DEVICE FAULT [VALUE] [for SECONDS]": "20 lms200 unplug for 2", "0 p2os bit-errors 1e-6". Errors show the
/// form.
[[nodiscard]] Result<FaultCommand> parse_fault_command(std::string_view text);

}  // namespace seeker::emulator
