/// \file
/// The drivers of a real robot.
#pragma once

#include <memory>

#include "server/drivers/hardware/hardware_settings.hpp"
#include "server/drivers/hardware/live_clock.hpp"
#include "server/drivers/interfaces/drivers.hpp"

namespace seeker::drivers {

/// Absent sensors are null.
struct HardwareDevices {
  std::shared_ptr<LiveClock> clock;
  std::shared_ptr<BaseDriver> base;
  std::shared_ptr<SonarDriver> sonar;
  std::shared_ptr<LidarDriver> lidar;
  std::shared_ptr<LidarDriver> second_lidar;
};

/// Makes the drivers; nothing is opened before they are activated. Errors name the field that is wrong.
[[nodiscard]] Result<HardwareDevices> make_hardware(const HardwareSettings& settings);

}  // namespace seeker::drivers
