/// \file
/// A bounded queue of updates from the robot's thread to the network thread, which never blocks the robot.
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <map>
#include <mutex>
#include <vector>

#include "common/api/robot_api.hpp"

namespace seeker::server_net {

/// LATEST topics keep their newest update, and of tiles the newest of each index. RELIABLE topics are queued; when the
/// network thread stalls until the queue is full, the oldest updates are dropped, which shows as a step in their
/// sequence.
class Mailbox {
 public:
  explicit Mailbox(std::size_t max_reliable) : max_reliable_(max_reliable) {}

  /// Adds an update. True: the mailbox was empty before, so that the caller must have it drained.
  [[nodiscard]] bool push(const api::UpdatePtr& update);
  /// Removes all waiting updates, RELIABLE ones first; the tiles are one update.
  [[nodiscard]] std::vector<api::UpdatePtr> drain();

 private:
  void push_tiles(const api::UpdatePtr& update);

  std::size_t max_reliable_;
  std::mutex mutex_;
  bool empty_ = true;
  std::deque<api::UpdatePtr> reliable_;
  std::array<api::UpdatePtr, api::kTopicCount> latest_;
  api::UpdatePtr tiles_head_;  ///< the newest update with tiles
  std::map<CellIndex, std::pair<api::UpdatePtr, const OccupancyTile*>>
      tiles_;  ///< the newest tile of each index, with its update
};

}  // namespace seeker::server_net
