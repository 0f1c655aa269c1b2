/// \file
/// YAML fields of the exploration.
#pragma once

#include "common/config/fields.hpp"
#include "server/explore/explore_params.hpp"
#include "server/options/nav_options.hpp"
#include "server/options/slam_options.hpp"

namespace seeker::tour {

void describe(config::Fields& f, RoomsParams& params);

}  // namespace seeker::tour

namespace seeker::explore {

void describe(config::Fields& f, SensorModel& params);
void describe(config::Fields& f, OneStepParams& params);
void describe(config::Fields& f, WallParams& params);
void describe(config::Fields& f, RoamParams& params);
void describe(config::Fields& f, ViewpointParams& params);
void describe(config::Fields& f, TourParams& params);
void describe(config::Fields& f, GuardParams& params);
void describe(config::Fields& f, ExploreParams& params);

}  // namespace seeker::explore
