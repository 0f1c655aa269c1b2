/// \file
/// What other robots have found, told once to the operator of this one.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/api/fleet.hpp"
#include "server/app/own_map.hpp"

namespace seeker::app {

/// For one thread.
class FleetNews {
 public:
  /// An event `fleet-found` for each finding that is new, and again where a target whose bearing alone was known has
  /// got a place. `findings` are in the robot's own frame `map`.
  void tell(const std::vector<api::FleetFinding>& findings, const FleetHost& host);

 private:
  std::map<std::pair<std::string, std::uint64_t>, bool> told_;  ///< by robot and its id: with a place
};

}  // namespace seeker::app
