/// \file
/// Notices that steps by the objective lead nowhere (spec S1.12).
#pragma once

#include <cstddef>
#include <vector>

#include "common/core/line_map.hpp"
#include "server/explore/one_step_params.hpp"
#include "server/nav/floor_view.hpp"

namespace seeker::explore {

/// How much is known.
struct MapSize {
  double walls_m = 0.0;  ///< sum of lengths
  std::size_t segments = 0;
  double floor_m2 = 0.0;  ///< known to be free
};
/// `floor` may be null.
[[nodiscard]] MapSize size_of(const std::vector<MapSegment>& segments, const nav::FloorView* floor);

/// A trap is, as in the paper, when no control promises anything on several decisions in a row. It is also one when
/// they promise something again and again and the map does not grow: the predictions are wrong there, and a robot that
/// only looks one step ahead would turn to and fro for ever. Growth counts against the largest map so far, so that
/// walls that come and go do not pass for it.
class TrapWatch {
 public:
  explicit TrapWatch(const OneStepParams& params) : params_(params) {}

  /// After a decision; true: trapped.
  [[nodiscard]] bool note(bool gains_nothing, const MapSize& size);
  /// Counting begins again; `suspicious`: the first decision that promises nothing is a trap.
  void reset(bool suspicious = false);

 private:
  OneStepParams params_;
  MapSize largest_;
  int hopeless_ = 0;   ///< decisions in a row that promised nothing
  int fruitless_ = 0;  ///< that brought nothing
};

}  // namespace seeker::explore
