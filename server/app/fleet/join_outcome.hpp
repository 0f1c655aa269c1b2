/// \file
/// What the judge of a fleet has found when it looked at all maps together.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/core/pose2.hpp"
#include "server/fleet/fleet_links.hpp"
#include "server/fleet/fleet_merge.hpp"

namespace seeker::app {

/// The outcome of one map join. Robots are named by their slots.
struct JoinOutcome {
  std::vector<fleet::PairAnswer> pairs;            ///< of the robots that take part
  std::map<std::uint8_t, fleet::FleetLink> links;  ///< of the robots that merged pairs lead to
  /// main_T_map of the robots whose maps are in the joint map; absent: there is no joint map.
  std::optional<std::map<std::uint8_t, Pose2>> main_T_maps;
  std::string trouble;  ///< why the maps of `links` could not be joined
};

}  // namespace seeker::app
