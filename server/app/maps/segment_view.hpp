/// \file
/// The estimator's segments, copied only when they have changed, and not too often: putting the pieces of each wall
/// together takes milliseconds in a large building.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/core/line_map.hpp"
#include "common/core/time.hpp"
#include "server/slam/map_tracker.hpp"

namespace seeker::app {

class SegmentView {
 public:
  /// `period`: shortest robot time between two copies.
  explicit SegmentView(Duration period) : period_(period) {}

  /// Valid until the next call.
  [[nodiscard]] const std::vector<MapSegment>& of(const slam::MapTracker& tracker, RobotTime now) {
    const bool due = !copied_at_ || now - *copied_at_ >= period_;
    if (due && revision_ != tracker.revision()) {
      revision_ = tracker.revision();
      copied_at_ = now;
      segments_ = tracker.segments();
    }
    return segments_;
  }
  /// Of the segments given out last.
  [[nodiscard]] std::uint64_t revision() const { return revision_.value_or(0); }
  /// The map moved: the next call copies.
  void forget() {
    copied_at_.reset();
    revision_.reset();
  }

 private:
  Duration period_;
  std::optional<std::uint64_t> revision_;  ///< of segments_
  std::optional<RobotTime> copied_at_;
  std::vector<MapSegment> segments_;
};

}  // namespace seeker::app
