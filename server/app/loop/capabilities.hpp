/// \file
/// What a robot can be asked to do, by the devices that it has.
#pragma once

#include <string>
#include <vector>

#include "server/app/runtime/devices.hpp"

namespace seeker::app {

/// The words of api::RobotInfo::capabilities. `has_segments`: its estimator keeps a map of line segments.
[[nodiscard]] std::vector<std::string> capabilities(const Devices& devices, bool has_segments);

}  // namespace seeker::app
