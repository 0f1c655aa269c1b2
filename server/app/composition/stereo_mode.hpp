/// \file
/// The methods that the stereo camera of a robot file may serve.
#pragma once

#include "common/config/fields.hpp"
#include "server/app/composition/robot_options.hpp"

namespace seeker::app {

/// Describes the mode. A file that names another one than its base sets all parameters of that mode; what no mode says
/// stays: where the camera is mounted, and how many key points it finds.
void describe_mode(config::Fields& f, StereoSettings& settings);

}  // namespace seeker::app
