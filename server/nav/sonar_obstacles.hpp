/// \file
/// Obstacles that sonars detect and the laser does not (chair legs, mats, glass).
#pragma once

#include <vector>

#include "common/core/map_move.hpp"
#include "server/nav/planned_driver.hpp"

namespace seeker::nav {

/// Collects sonar echoes. An echo becomes an obstacle when it came from about the same place several times and no laser
/// return there explains it.
class SonarObstacles {
 public:
  void note(const DriveInput& input);
  void transform(const MapMove& move);

 private:
  struct Echo {
    Point2 p_map;
    RobotTime seen;
    int times = 0;
  };
  void note_echo(const Point2& p_map, const DriveInput& input);

  std::vector<Echo> echoes_;
  RobotTime stamp_;  ///< stamp of the last scan used, so that a scan is counted once
};

}  // namespace seeker::nav
