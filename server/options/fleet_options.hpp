/// \file
/// YAML fields of everything a robot does with the topology of its building.
#pragma once

#include "common/config/fields.hpp"
#include "server/fleet/topological_strategy.hpp"

namespace seeker::fleet {

void describe(config::Fields& f, SpaceTreeParams& params);
void describe(config::Fields& f, AuctionParams& params);
void describe(config::Fields& f, TopologicalParams& params);

}  // namespace seeker::fleet
