/// \file
/// Where to wait next for a way to become free again, and when waiting is over.
#pragma once

#include <optional>
#include <vector>

#include "common/core/map_move.hpp"
#include "common/core/pose2.hpp"

namespace seeker::nav {

struct WaitParams {
  int max_waits = 6;       ///< at one place where somebody stands in the way
  int max_for_nobody = 3;  ///< at all places where nobody was seen, beyond the first of each
};

struct BlockedPlace {
  Point2 p_map = Point2::Zero();
  /// A way led there before, or somebody is seen to stand in it. Else it may just as well be a gap that is too narrow.
  bool somebody = false;
};

struct WaitTurn {
  Point2 p_map = Point2::Zero();
  /// Every second time that somebody is waited for the robot leaves the way: two who wait for each other wait for ever.
  bool aside = false;

  friend bool operator==(const WaitTurn&, const WaitTurn&) = default;
};

/// Each place has its turn before any has the next. So a mission goes on after a bounded time, however people
/// walk.
class WaitTurns {
 public:
  explicit WaitTurns(const WaitParams& params) : params_(params) {}

  /// The place whose turn it is, which counts as waited for from now on; nothing when none deserves another wait.
  [[nodiscard]] std::optional<WaitTurn> next(const std::vector<BlockedPlace>& places);
  /// Waiting had a use: all have their turns again.
  void reset();
  /// The map moved.
  void transform(const MapMove& move);

 private:
  struct Waited {
    Point2 p_map;
    int turns = 0;
  };
  /// Null where nobody was waited for.
  [[nodiscard]] Waited* known(const Point2& p_map);

  WaitParams params_;
  std::vector<Waited> waited_;
  int total_ = 0;
  int for_nobody_ = 0;  ///< of them where nobody was seen
};

}  // namespace seeker::nav
