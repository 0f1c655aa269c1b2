/// \file
/// What one robot of a fleet may be sent of another one, in its own frame.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/api/fleet.hpp"
#include "common/core/time.hpp"
#include "server/app/fleet/robot_report.hpp"

namespace seeker::app {

/// Another robot whose map is merged, as a copy: it needs no lock.
struct OtherRobot {
  std::string robot_id;
  RobotReport report;   ///< in its own frame `map`
  Pose2 map_T_theirs;   ///< pose of that frame in the frame `map` of the robot that receives the report
  bool silent = false;  ///< it has not reported its topology for too long: its goals are anybody's
};

// All of these are in the frame `map` of the robot that receives them. What lies out of reach there is left out, since
// the receiver would refuse all of it.

[[nodiscard]] std::vector<RobotTopology> topologies_of(const std::vector<OtherRobot>& others);
/// Each with the pose of its frame.
[[nodiscard]] std::vector<std::pair<Pose2, nav::SharedFloor>> floors_of(const std::vector<OtherRobot>& others);
[[nodiscard]] std::vector<MappedSide> sides_by(const std::vector<OtherRobot>& others);
[[nodiscard]] std::vector<api::FleetFinding> findings_of(const std::vector<OtherRobot>& others);
/// Without floor that was last reported `max_age` ago or earlier: objects and people move, so that it proves nothing.
[[nodiscard]] std::vector<SearchedFloor> searched_by(const std::vector<OtherRobot>& others, WallTime now,
                                                     Duration max_age);

}  // namespace seeker::app
