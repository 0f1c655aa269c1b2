/// \file
/// The methods that the stereo camera of a robot file may serve.
#pragma once

#include "server/app/composition/robot_options.hpp"

namespace seeker::app {

/// Sets all parameters of the settings' mode. What no mode says stays: where the camera is mounted, and how many key
/// points it finds.
void take_mode(StereoSettings& settings);

}  // namespace seeker::app
