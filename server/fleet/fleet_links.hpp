/// \file
/// Which robots of a fleet hang together with the main one: by their own maps, or over those of others.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "server/fleet/fleet_merge.hpp"

namespace seeker::fleet {

/// How a robot hangs together with the main one.
struct FleetLink {
  std::uint8_t through = 0;  ///< slot of the robot that its map is merged with; the main one's where directly
  double confidence = 0.0;   ///< of the least sure pair on the way
};

/// By slot, without the main one: robots that merged pairs lead to. The way of each is the one whose least sure pair is
/// surest.
[[nodiscard]] std::map<std::uint8_t, FleetLink> links_from(std::uint8_t main, const std::vector<PairAnswer>& pairs);

}  // namespace seeker::fleet
