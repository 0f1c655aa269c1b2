/// \file
/// YAML fields of the simulated robot.
#pragma once

#include "common/config/fields.hpp"
#include "server/sim/robot_model.hpp"

namespace seeker::sim {

void describe(config::Fields& f, OdometryModel& model);
void describe(config::Fields& f, LidarModel& model);
void describe(config::Fields& f, SonarModel& model);
void describe(config::Fields& f, OmniModel& model);
void describe(config::Fields& f, TankCameraModel& model);
void describe(config::Fields& f, EyeErrors& errors);
void describe(config::Fields& f, StereoModel& model);
void describe(config::Fields& f, RobotModel& model);

}  // namespace seeker::sim
