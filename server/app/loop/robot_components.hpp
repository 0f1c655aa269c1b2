/// \file
/// add_components() lists what a robot is composed of: its components, their ports and who feeds whom.
#pragma once

#include "server/app/loop/loop_params.hpp"
#include "server/app/runtime/components.hpp"

namespace seeker::app {

/// Registers all components of a robot and connects their ports as `connections` says.
void add_components(Components& components, const LoopParts& parts, const Devices& devices,
                    const Connections& connections);

}  // namespace seeker::app
