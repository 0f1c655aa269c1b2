/// \file
/// Field descriptions of the real devices and of what their wheels are found to be.
#pragma once

#include "common/config/fields.hpp"
#include "common/core/wheel_calibration.hpp"
#include "server/drivers/hardware/hardware_settings.hpp"

namespace seeker {

void describe(config::Fields& f, WheelCalibration& calibration);

}  // namespace seeker

namespace seeker::drivers {

void describe(config::Fields& f, HardwareSettings& settings);

}  // namespace seeker::drivers
