#include "server/app/maps/segment_log.hpp"

namespace seeker::app {

bool SegmentLog::take(const std::vector<MapSegment>& segments, std::uint32_t map_epoch) {
  const std::uint64_t next = revision_ + 1;
  bool changed = map_epoch != map_epoch_;
  if (changed) {
    map_epoch_ = map_epoch;
    segments_.clear();
    removals_.clear();
    full_before_ = next;
  }
  for (auto& [id, entry] : segments_) {
    entry.present = false;
  }
  for (const MapSegment& segment : segments) {
    Entry& entry = segments_[segment.id];
    entry.present = true;
    if (entry.changed == 0 || entry.segment != segment) {
      entry.segment = segment;
      entry.changed = next;
      changed = true;
    }
  }
  for (auto it = segments_.begin(); it != segments_.end();) {
    if (it->second.present) {
      ++it;
      continue;
    }
    removals_.push_back({it->first, next});
    changed = true;
    it = segments_.erase(it);
  }
  while (removals_.size() > params_.removals) {
    full_before_ = removals_.front().revision;
    removals_.pop_front();
  }
  revision_ = changed ? next : revision_;
  return changed;
}

api::SegmentUpdate SegmentLog::since(std::uint64_t revision) const {
  api::SegmentUpdate update;
  update.revision = revision_;
  update.map_epoch = map_epoch_;
  update.full = revision == 0 || revision < full_before_ || revision > revision_;
  for (const auto& [id, entry] : segments_) {
    if (update.full || entry.changed > revision) {
      update.changed.push_back(entry.segment);
    }
  }
  for (const Removal& removal : removals_) {
    if (!update.full && removal.revision > revision) {
      update.removed.push_back(removal.id);
    }
  }
  return update;
}

}  // namespace seeker::app
