/// \file
/// The way of updates from the robot's thread to the network's: bounded, never blocking the robot.
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <map>
#include <mutex>
#include <vector>

#include "common/api/robot_api.hpp"

namespace seeker::server_net {

/// LATEST: the newest of each topic, and of tiles the newest of each index. RELIABLE: a queue; when the network thread
/// stands still for so long that it is full, the oldest go, which shows as a step in their sequence.
class Mailbox {
 public:
  explicit Mailbox(std::size_t max_reliable) : max_reliable_(max_reliable) {}

  /// True: it was empty before, so somebody must be told to drain it.
  [[nodiscard]] bool push(const api::UpdatePtr& update);
  /// All that waits, RELIABLE first; the tiles as one update.
  [[nodiscard]] std::vector<api::UpdatePtr> drain();

 private:
  void push_tiles(const api::UpdatePtr& update);

  std::size_t max_reliable_;
  std::mutex mutex_;
  bool empty_ = true;
  std::deque<api::UpdatePtr> reliable_;
  std::array<api::UpdatePtr, api::kTopicCount> latest_;
  api::UpdatePtr tiles_head_;                                                   ///< newest update that held tiles
  std::map<CellIndex, std::pair<api::UpdatePtr, const OccupancyTile*>> tiles_;  ///< where each newest tile lies
};

}  // namespace seeker::server_net
