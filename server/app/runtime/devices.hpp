/// \file
/// The drivers of one robot: of hardware, of a simulation or of a recording.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "server/drivers/interfaces/drivers.hpp"

namespace seeker::app {

/// What a robot is made of. Absent sensors are null; base and clock are always there.
struct Devices {
  std::string type;  ///< "sim", "replay": shown in the component list
  std::shared_ptr<drivers::Clock> clock;
  std::shared_ptr<drivers::BaseDriver> base;
  std::shared_ptr<drivers::LidarDriver> lidar;
  std::shared_ptr<drivers::SonarDriver> sonar;
  std::shared_ptr<drivers::CameraDriver> camera;
  std::string camera_name = "omni";  ///< as clients call it
  std::shared_ptr<drivers::StereoDriver> stereo;
  bool runs_without_mission = false;     ///< a replay goes on by itself; a simulated world stands still
  std::function<std::string()> summary;  ///< what the source says at its end; may be empty
};

}  // namespace seeker::app
