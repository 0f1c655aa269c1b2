/// \file
/// Field descriptions of the real devices.
#pragma once

#include "common/config/fields.hpp"
#include "server/drivers/hardware/hardware_settings.hpp"

namespace seeker::drivers {

void describe(config::Fields& f, HardwareSettings& settings);

}  // namespace seeker::drivers
