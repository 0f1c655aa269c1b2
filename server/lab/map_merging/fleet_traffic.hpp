/// \file
/// Amount of data that a robot of a fleet sends to the main one (app::FleetFollower), counted without a network.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "common/api/fleet.hpp"
#include "common/core/line_map.hpp"
#include "common/core/occupancy_tile.hpp"
#include "common/core/topology.hpp"
#include "server/fleet/node_picture.hpp"

namespace seeker::lab {

/// Counts the payloads of all messages of one robot so far; frames and the overhead of the network are left out.
class FleetTraffic {
 public:
  explicit FleetTraffic(std::string robot_id) : robot_id_(std::move(robot_id)) {}

  /// Counts the manifest and the pieces that were not sent yet. A map that cannot be packed sends nothing.
  void announce(const LineMap& map, const fleet::NodePictures& pictures = {});
  void share(const RobotTopology& topology);
  void seen(const std::vector<OccupancyTile>& tiles, const std::vector<MappedSide>& sides);

  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

 private:
  std::string robot_id_;
  std::set<api::PieceHash> sent_;
  std::uint64_t bytes_ = 0;
};

}  // namespace seeker::lab
