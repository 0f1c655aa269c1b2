#include "server/app/loop/capabilities.hpp"

#include <initializer_list>

namespace seeker::app {

std::vector<std::string> capabilities(const Devices& devices, bool has_segments) {
  std::vector<std::string> words;
  const bool drivable = devices.base->drivable().has_value();
  const auto add = [&words](bool there, std::initializer_list<const char*> more) {
    words.insert(words.end(), there ? more.begin() : more.end(), more.end());
  };
  add(drivable, {"goto", "return", "drive"});
  add(devices.stereo && drivable, {"survey"});
  add(devices.stereo != nullptr, {"localise", "camera:left", "camera:right"});
  add(devices.camera && drivable, {"search"});
  if (devices.camera) {
    words.insert(words.end(), {"recognise", "camera:" + devices.camera_name});
  }
  add(devices.lidar != nullptr, {"lidar"});
  add(devices.sonar != nullptr, {"sonar"});
  add(has_segments, {"line_map"});
  add(has_segments && drivable, {"explore"});
  return words;
}

}  // namespace seeker::app
