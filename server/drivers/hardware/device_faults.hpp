/// \file
/// From what a session says of its device to the faults of a driver.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "server/drivers/interfaces/drivers.hpp"

namespace seeker::drivers {

/// A sentence of cause and remedy, apart by its last semicolon.
[[nodiscard]] DeviceFault fault_of(std::string id, const Error& error, bool blocking);
/// The fault "starting" of a device that is being opened, "lost" of one whose link does not work, and its warning
/// "warning", where they are.
[[nodiscard]] std::vector<DeviceFault> faults_of(const Status& state, const std::optional<Error>& warning);

}  // namespace seeker::drivers
