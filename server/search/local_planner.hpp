/// \file
/// From sonar readings and a target bearing to a velocity: the control table and the drive law, with virtual walls
/// (spec S3.2).
#pragma once

#include <memory>

#include "common/core/result.hpp"
#include "common/core/scan.hpp"
#include "common/core/time.hpp"
#include "server/search/control_table.hpp"
#include "server/search/drive_law.hpp"
#include "server/search/sectors.hpp"

namespace seeker::search {

struct LocalPlannerParams {
  DriveLawParams drive;
  double silence_s = 0.5;      ///< readings older than this count as missing
  double ring_radius_m = 0.2;  ///< distance from the robot's centre to its sonars, for virtual walls
};

/// The reactive planner of the paper.
class LocalPlanner {
 public:
  LocalPlanner(std::shared_ptr<const ControlTable> table, nav::ForbiddenAreas areas, const LocalPlannerParams& params);

  /// The present sectors, or why the robot must stop: no ring, missing readings, invalid readings.
  [[nodiscard]] Result<Sectors> sense(const SonarScan* sonar, const Pose2& map_T_base, RobotTime now) const;
  /// Command towards `target_rad` (bearing in the base), or why the robot must stop.
  [[nodiscard]] Result<Twist2> drive(const Sectors& sectors, double target_rad) const;

 private:
  std::shared_ptr<const ControlTable> table_;
  nav::ForbiddenAreas areas_;
  LocalPlannerParams params_;
};

}  // namespace seeker::search
