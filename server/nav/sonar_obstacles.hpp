/// \file
/// Things that sonars see and the laser does not (chair legs, mats, glass): obstacles of the floor.
#pragma once

#include <vector>

#include "common/core/map_move.hpp"
#include "server/nav/planned_driver.hpp"

namespace seeker::nav {

/// An echo becomes an obstacle when it came from about the same place several times, and the laser shows nothing there
/// that explains it.
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
  RobotTime stamp_;  ///< of the last scan used: one that stands still is not seen again and again
};

}  // namespace seeker::nav
