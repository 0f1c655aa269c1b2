#include "common/api/map.hpp"

#include <algorithm>

namespace seeker::api {

std::string_view to_string(MapUse use) { return use == MapUse::kLocalise ? "localise" : "continue"; }

std::vector<SegmentUpdate> split(const SegmentUpdate& update) {
  std::vector<SegmentUpdate> parts;
  std::size_t removed = 0;
  std::size_t changed = 0;
  do {
    SegmentUpdate part;
    part.revision = update.revision;
    part.map_epoch = update.map_epoch;
    part.full = update.full && parts.empty();
    const std::size_t gone = std::min(kMaxSegmentsPerUpdate, update.removed.size() - removed);
    const std::size_t moved = std::min(kMaxSegmentsPerUpdate - gone, update.changed.size() - changed);
    const auto removed_from = update.removed.begin() + static_cast<std::ptrdiff_t>(removed);
    const auto changed_from = update.changed.begin() + static_cast<std::ptrdiff_t>(changed);
    part.removed.assign(removed_from, removed_from + static_cast<std::ptrdiff_t>(gone));
    part.changed.assign(changed_from, changed_from + static_cast<std::ptrdiff_t>(moved));
    removed += gone;
    changed += moved;
    parts.push_back(std::move(part));
  } while (removed < update.removed.size() || changed < update.changed.size());
  return parts;
}

}  // namespace seeker::api
