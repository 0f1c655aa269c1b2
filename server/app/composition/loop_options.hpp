/// \file
/// Which YAML fields fill the parameters of the robot loop.
#pragma once

#include "common/config/fields.hpp"
#include "server/app/loop/loop_params.hpp"

namespace seeker::app {

void describe(config::Fields& f, LoopParams& params);
void describe(config::Fields& f, Connections& connections);

}  // namespace seeker::app
