/// \file
/// Connections of the robots of a fleet with the main one: by their own maps, or over those of others.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "server/fleet/fleet_merge.hpp"

namespace seeker::fleet {

/// Connection of a robot with the main one.
struct FleetLink {
  /// Slot of the robot with which its map is merged; that of the main one for a direct connection.
  std::uint8_t through = 0;
  double confidence = 0.0;  ///< confidence of the least certain pair on the path
};

/// The robots connected with the main one by merged pairs, by slot, without the main one. Of several paths the one
/// whose least certain pair is the most certain is chosen.
[[nodiscard]] std::map<std::uint8_t, FleetLink> links_from(std::uint8_t main, const std::vector<PairAnswer>& pairs);

}  // namespace seeker::fleet
