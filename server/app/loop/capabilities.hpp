/// \file
/// capabilities() lists what a robot can be asked to do, given its devices.
#pragma once

#include <string>
#include <vector>

#include "server/app/runtime/devices.hpp"

namespace seeker::app {

/// Returns the words of api::RobotInfo::capabilities. `has_segments` says whether the estimator keeps a map of line
/// segments.
[[nodiscard]] std::vector<std::string> capabilities(const Devices& devices, bool has_segments);

}  // namespace seeker::app
