/// \file
/// YAML fields of what a robot does with the topology of its building, and of the merging of maps.
#pragma once

#include "common/config/fields.hpp"
#include "server/fleet/map_merger.hpp"
#include "server/fleet/topological_strategy.hpp"

namespace seeker::vision {

void describe(config::Fields& f, MatchParams& params);
void describe(config::Fields& f, ViewMatchParams& params);

}  // namespace seeker::vision

namespace seeker::fleet {

void describe(config::Fields& f, SpaceTreeParams& params);
void describe(config::Fields& f, AuctionParams& params);
void describe(config::Fields& f, TopologicalParams& params);
void describe(config::Fields& f, IcpParams& params);
void describe(config::Fields& f, PairCheckParams& params);
void describe(config::Fields& f, OverlapParams& params);
void describe(config::Fields& f, PictureParams& params);
void describe(config::Fields& f, MergeParams& params);

}  // namespace seeker::fleet
