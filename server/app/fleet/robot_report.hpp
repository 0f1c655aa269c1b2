/// \file
/// What one robot of a fleet has reported of itself.
#pragma once

#include <chrono>
#include <optional>
#include <vector>

#include "common/api/fleet.hpp"
#include "common/core/searched_floor.hpp"
#include "common/core/topology.hpp"
#include "server/nav/shared_floor.hpp"

namespace seeker::app {

/// Reports age by the wall clock, since robots of one fleet share no robot time.
using WallTime = std::chrono::steady_clock::time_point;

/// The last report of one robot, in its own frame `map`. It is a plain value without a lock: whoever owns it guards it.
struct RobotReport {
  /// Targets that the robot has found.
  struct Finds {
    std::vector<api::Detection> now;     ///< reported by the program that runs
    std::vector<api::Detection> before;  ///< reported by programs of this robot that have ended
    /// Both within the limits of a fleet, each id once; what the running program reports has precedence.
    [[nodiscard]] std::vector<api::Detection> all() const;
  };
  /// Floor that the robot has searched.
  struct Search {
    std::optional<SearchedFloor> floor;
    WallTime changed;  ///< when the robot last reported another floor than before
    /// An absent report changes nothing: a robot that was restarted has lost what it searched, but the floor was
    /// searched all the same.
    void receive(std::optional<SearchedFloor> reported, WallTime received_at);
  };

  std::optional<RobotTopology> topology;
  nav::SharedFloor floor;  ///< null: the robot has not reported any floor
  SharedSides sides;       ///< null: nor any walls
  Finds finds;
  Search search;

  /// A robot that was restarted, or has lost its pose, knows fewer places than it reported before: those stay.
  void receive_topology(const std::optional<RobotTopology>& reported);
  /// Takes the floor and the walls that were seen, the targets that were found and the floor that was searched. The
  /// answer is whether the targets are others than before.
  [[nodiscard]] bool receive_seen(const std::vector<OccupancyTile>& tiles, std::vector<MappedSide> seen_sides,
                                  const std::vector<api::Detection>& detections,
                                  const std::optional<SearchedFloor>& searched, WallTime received_at);
  /// All finds in another frame, without those that lie out of reach there: their receiver would refuse all of them.
  [[nodiscard]] std::vector<api::Detection> finds_in(const Pose2& other_T_map) const;
};

}  // namespace seeker::app
