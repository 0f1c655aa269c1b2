/// \file
/// A robot in the world that seeker-emulator hosts, behind the driver interfaces, so that the loop uses it like
/// hardware.
#pragma once

#include <memory>

#include "server/drivers/emulator/emulator_link.hpp"
#include "server/drivers/interfaces/drivers.hpp"

namespace seeker::drivers {

struct EmulatorDevices {
  std::unique_ptr<Clock> clock;
  std::unique_ptr<BaseDriver> base;
  std::unique_ptr<LidarDriver> lidar;
  std::unique_ptr<SonarDriver> sonar;
  std::unique_ptr<CameraDriver> camera;
  std::unique_ptr<StereoDriver> stereo;
};

[[nodiscard]] EmulatorDevices make_emulator_devices(const std::shared_ptr<EmulatorLink>& link);

}  // namespace seeker::drivers
