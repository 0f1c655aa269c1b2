/// \file
/// Whether a robot leads a fleet or joins one.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "common/core/time.hpp"
#include "common/net/link_security.hpp"
#include "server/fleet/map_merger.hpp"

namespace seeker::app {

/// What the lines of the log that speak of the fleet begin with.
inline constexpr std::string_view kFleetPart = "fleet";

struct FleetSettings {
  bool lead = false;                                ///< others may join this robot
  std::string address = "127.0.0.1";                ///< of the interface to listen on for them
  std::uint16_t port = 7473;                        ///< 0: any free one
  std::string join;                                 ///< host:port of the main robot's fleet; empty: joins none
  Duration period = std::chrono::seconds(5);        ///< wall time between announcements of the map
  Duration share_period = std::chrono::seconds(1);  ///< wall time between those of where the robot goes
  Duration floor_period = std::chrono::seconds(5);  ///< wall time between those of the floor that it has seen
  /// Wall time of silence after which a robot counts as gone: its goals are anybody's, and its id may be taken over.
  Duration silence_limit = std::chrono::seconds(5);
  /// Wall time after which what a robot has searched proves nothing to the others any more, unless it searches on.
  Duration search_age = std::chrono::hours(1);
  fleet::MergeParams merge;
  net::LinkSecurity security;  ///< of the port, and of the link to the main robot; not a field: as that of the server
};

}  // namespace seeker::app
