/// \file
/// The estimator's segments, copied only when they have changed.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/core/line_map.hpp"
#include "server/slam/map_tracker.hpp"

namespace seeker::app {

class SegmentView {
 public:
  /// Valid until the next call.
  [[nodiscard]] const std::vector<MapSegment>& of(const slam::MapTracker& tracker) {
    if (revision_ != tracker.revision()) {
      revision_ = tracker.revision();
      segments_ = tracker.segments();
    }
    return segments_;
  }

 private:
  std::optional<std::uint64_t> revision_;  ///< of segments_
  std::vector<MapSegment> segments_;
};

}  // namespace seeker::app
