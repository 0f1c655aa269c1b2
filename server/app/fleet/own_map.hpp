/// \file
/// What leaves a robot's loop for its fleet, and what comes back.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/api/robot_api.hpp"
#include "common/core/line_map.hpp"
#include "common/core/searched_floor.hpp"
#include "common/core/topology.hpp"
#include "server/fleet/node_picture.hpp"
#include "server/nav/shared_floor.hpp"

namespace seeker::app {

/// A robot's map, and where it is in it; no place where it does not know. Pictures of its topology's nodes.
struct OwnMap {
  LineMap map;
  std::optional<Pose2> map_T_base;
  fleet::NodePictures pictures{};
};
/// What it reports of where it has been and means to go, frame `map`; nothing where it does not know its place.
using OwnTopology = std::optional<RobotTopology>;

/// What it has seen, frame `map`, within the limits of a fleet.
struct OwnSeen {
  bool placed = false;  ///< it knows its place; else the rest is empty, and what it reported before holds
  std::vector<OccupancyTile> floor;
  std::vector<api::Detection> detections;  ///< that belong to the map as it is now
  std::optional<SearchedFloor> searched;
  std::vector<MappedSide> sides = {};
};
/// Null where nothing has been seen.
[[nodiscard]] nav::SharedFloor floor_of(const std::vector<OccupancyTile>& tiles);
/// A list that several holders share without copying; null where it is empty, `before` where that says the same.
template <class T>
[[nodiscard]] std::shared_ptr<const std::vector<T>> shared_list(std::vector<T> list,
                                                                const std::shared_ptr<const std::vector<T>>& before) {
  if (list.empty() || (before && *before == list)) {
    return list.empty() ? nullptr : before;
  }
  return std::make_shared<const std::vector<T>>(std::move(list));
}

/// The robot as its fleet sees it. None is empty; all may be called from any thread. The first three answer on the
/// loop's thread, or at once where the loop has ended.
struct FleetHost {
  std::function<void(const api::Reply<OwnMap>&)> give_map;
  std::function<void(const api::Reply<OwnTopology>&)> give_topology;
  std::function<void(const api::Reply<OwnSeen>&)> give_seen;
  /// What the robot knows of the others from now on, frame `map`; nothing: it is alone.
  std::function<void(std::optional<FleetView>)> take_view;
  /// An event of the robot; returns at once and calls nobody back.
  std::function<void(const std::string& kind, const std::string& text, api::Severity)> notify_operator;
  /// Somebody has decided about another robot, or was refused: to be kept, without robot time; returns at once.
  std::function<void(const api::AuditRecord&)> decided;
};

}  // namespace seeker::app
