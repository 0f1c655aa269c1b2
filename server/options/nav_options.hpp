/// \file
/// YAML fields of occupancy, planning and following.
#pragma once

#include "common/config/fields.hpp"
#include "server/nav/clearance.hpp"
#include "server/nav/cost_map.hpp"
#include "server/nav/occupancy_map.hpp"
#include "server/nav/path_follower.hpp"
#include "server/nav/planned_driver.hpp"
#include "server/nav/planner.hpp"
#include "server/nav/retry_drive.hpp"
#include "server/nav/wait_schedule.hpp"

namespace seeker::nav {

void describe(config::Fields& f, OccupancyParams& params);
void describe(config::Fields& f, CostMapParams& params);
void describe(config::Fields& f, PlannerParams& params);
void describe(config::Fields& f, ClearanceParams& params);
void describe(config::Fields& f, FollowerParams& params);
void describe(config::Fields& f, DriverParams& params);
void describe(config::Fields& f, RetryParams& params);
void describe(config::Fields& f, WaitParams& params);

}  // namespace seeker::nav
