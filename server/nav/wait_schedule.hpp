/// \file
/// Choice of the blocked place to wait at next, and of when to stop waiting.
#pragma once

#include <optional>
#include <vector>

#include "common/core/map_move.hpp"
#include "common/core/pose2.hpp"

namespace seeker::nav {

struct WaitParams {
  int max_waits = 6;  ///< largest number of waits at one place where somebody blocks the path
  /// Largest number of waits at all places where nobody was seen, beyond the first wait at each.
  int max_for_nobody = 3;
};

struct BlockedPlace {
  Point2 p_map = Point2::Zero();
  /// Whether a path led there before, or somebody is seen to stand there. Otherwise it may as well be a gap that is too
  /// narrow.
  bool somebody = false;
};

struct PlannedWait {
  Point2 p_map = Point2::Zero();
  /// At every second wait for somebody the robot moves aside, because two who wait for each other would wait for ever.
  bool aside = false;

  friend bool operator==(const PlannedWait&, const PlannedWait&) = default;
};

/// Schedules waits: every place has had its wait before any place has another. The total number of waits is
/// bounded, so a mission continues after a bounded time.
class WaitSchedule {
 public:
  explicit WaitSchedule(const WaitParams& params) : params_(params) {}

  /// The place to wait at next, which is counted as waited at from now on. Nothing: no place justifies another wait.
  [[nodiscard]] std::optional<PlannedWait> next(const std::vector<BlockedPlace>& places);
  /// A wait was successful: the counts of all places start again.
  void reset();
  /// The map was corrected.
  void transform(const MapMove& move);

 private:
  struct Waited {
    Point2 p_map;
    int waits = 0;
  };
  /// The record of the place; null where the robot has not waited.
  [[nodiscard]] Waited* known(const Point2& p_map);

  WaitParams params_;
  std::vector<Waited> waited_;
  int total_ = 0;
  int for_nobody_ = 0;  ///< waits at places where nobody was seen
};

}  // namespace seeker::nav
