/// \file
/// What changed in a map of segments since a revision: a value, fed with the whole map now and then.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <vector>

#include "common/api/map.hpp"

namespace seeker::app {

struct SegmentLogParams {
  std::size_t removals = 20'000;  ///< kept; a client that missed more gets the whole map
};

class SegmentLog {
 public:
  explicit SegmentLog(const SegmentLogParams& params = {}) : params_(params) {}

  /// Compares with the map taken before; the revision rises by one when anything differs. A new epoch means that all
  /// of it moved. True when it rose.
  bool take(const std::vector<MapSegment>& segments, std::uint32_t map_epoch);
  /// 0 before the first segment.
  [[nodiscard]] std::uint64_t revision() const { return revision_; }
  [[nodiscard]] std::size_t size() const { return segments_.size(); }
  /// The whole map, marked as full, for 0, for a revision of an older epoch or of another run, and for one whose
  /// removals are no longer kept.
  [[nodiscard]] api::SegmentUpdate since(std::uint64_t revision) const;

 private:
  struct Entry {
    MapSegment segment;
    std::uint64_t changed = 0;  ///< revision
    bool present = false;       ///< in the map that is being taken
  };
  struct Removal {
    std::uint64_t id = 0;
    std::uint64_t revision = 0;
  };

  SegmentLogParams params_;
  std::map<std::uint64_t, Entry> segments_;
  std::deque<Removal> removals_;
  std::uint64_t revision_ = 0;
  std::uint64_t full_before_ = 0;  ///< changes since a revision below this are not known one by one
  std::uint32_t map_epoch_ = 0;
};

}  // namespace seeker::app
