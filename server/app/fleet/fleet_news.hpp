/// \file
/// What other robots have found, reported once to the operator of this one.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "common/api/fleet.hpp"
#include "server/app/fleet/own_map.hpp"

namespace seeker::app {

/// For one thread.
class FleetNews {
 public:
  /// An event `fleet-found` for each finding that is new, and again where a target whose bearing alone was known has
  /// got a place. `findings` are in the robot's own frame `map`, all that there are: one that is not among them any
  /// more is forgotten, and news if it comes back. So no more is remembered than fits into one answer.
  void report(const std::vector<api::FleetFinding>& findings, const FleetHost& host);

 private:
  using Key = std::pair<std::string, std::uint64_t>;  ///< robot and its id

  std::map<Key, bool> reported_;  ///< with a place
};

}  // namespace seeker::app
