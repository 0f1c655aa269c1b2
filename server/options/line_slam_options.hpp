/// \file
/// YAML fields of line SLAM.
#pragma once

#include "common/config/fields.hpp"
#include "server/slam/line_slam_params.hpp"

namespace seeker::slam {

void describe(config::Fields& f, PointNetParams& params);
void describe(config::Fields& f, LocalMapParams& params);
void describe(config::Fields& f, LoopPolicy& params);
void describe(config::Fields& f, RelocaliseParams& params);
void describe(config::Fields& f, FusionParams& params);
void describe(config::Fields& f, LineSlamParams& params);

}  // namespace seeker::slam
