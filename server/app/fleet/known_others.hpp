/// \file
/// What a robot that has joined a fleet knows of the others.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "common/api/fleet.hpp"
#include "server/app/fleet/fleet_news.hpp"
#include "server/app/fleet/own_map.hpp"
#include "server/nav/shared_floor.hpp"

namespace seeker::app {

/// Makes the view of the robot from the answers of the main robot, and gives it to the robot whenever it changes. It is
/// for one thread, that of the follower, and has no lock.
class KnownOthers {
 public:
  KnownOthers(std::string robot_id, FleetHost host) : robot_id_(std::move(robot_id)), host_(std::move(host)) {}

  /// The topologies of the others, or why the main robot gave no answer. Without a link the robot goes on alone, but
  /// places that others have been at were seen all the same: it keeps them, and takes up the goals of the others, since
  /// nobody can say whether they still go there. The same while its map waits to be judged, as after a restart of the
  /// main robot. What was denied since is dropped.
  void receive(const Result<api::FleetShared>& shared);
  /// What the others have seen; the robot gets it with the next topologies.
  void receive(api::FleetSightings sightings);

 private:
  const std::string robot_id_;
  const FleetHost host_;
  nav::SharedFloor floor_;
  SharedSearch searched_;
  SharedSides sides_;
  FleetNews news_;
  std::optional<FleetView> view_;  ///< what the robot got last
};

}  // namespace seeker::app
