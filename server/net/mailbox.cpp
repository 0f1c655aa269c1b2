#include "server/net/mailbox.hpp"

#include <utility>

namespace seeker::server_net {

bool Mailbox::push(const api::UpdatePtr& update) {
  const std::lock_guard lock(mutex_);
  if (api::stream_class(update->topic) == api::StreamClass::kReliable) {
    if (reliable_.size() >= max_reliable_) {
      reliable_.pop_front();
    }
    reliable_.push_back(update);
  } else if (update->topic == api::Topic::kTiles) {
    push_tiles(update);
  } else {
    latest_[static_cast<std::size_t>(update->topic)] = update;
  }
  return std::exchange(empty_, false);  // true exactly for the first one since drain()
}

void Mailbox::push_tiles(const api::UpdatePtr& update) {
  const auto* tiles = std::get_if<api::TileUpdate>(&update->payload);
  if (tiles == nullptr) {
    return;
  }
  if (tiles_head_ && std::get<api::TileUpdate>(tiles_head_->payload).map_epoch != tiles->map_epoch) {
    tiles_.clear();
  }
  tiles_head_ = update;
  for (const OccupancyTile& tile : tiles->tiles) {
    tiles_[tile.index] = {update, &tile};
  }
}

std::vector<api::UpdatePtr> Mailbox::drain() {
  std::deque<api::UpdatePtr> reliable;
  std::array<api::UpdatePtr, api::kTopicCount> latest;
  api::UpdatePtr head;
  std::map<CellIndex, std::pair<api::UpdatePtr, const OccupancyTile*>> tiles;
  {
    const std::lock_guard lock(mutex_);
    reliable.swap(reliable_);
    latest.swap(latest_);
    head.swap(tiles_head_);
    tiles.swap(tiles_);
    empty_ = true;
  }
  std::vector<api::UpdatePtr> out(reliable.begin(), reliable.end());
  for (api::UpdatePtr& update : latest) {
    if (update) {
      out.push_back(std::move(update));
    }
  }
  if (head) {
    auto joined = std::make_shared<api::Update>();
    joined->topic = api::Topic::kTiles;
    joined->sequence = head->sequence;
    joined->stamp = head->stamp;
    const auto& newest = std::get<api::TileUpdate>(head->payload);
    api::TileUpdate all{newest.revision, newest.map_epoch, {}};
    all.tiles.reserve(tiles.size());
    for (const auto& [index, entry] : tiles) {
      all.tiles.push_back(*entry.second);
    }
    joined->payload = std::move(all);
    out.push_back(std::move(joined));
  }
  return out;
}

}  // namespace seeker::server_net
