/// \file
/// Detection of local traps, where steps by the objective bring no gain (spec S1.12).
#pragma once

#include <cstddef>
#include <vector>

#include "common/core/line_map.hpp"
#include "server/explore/one_step_params.hpp"
#include "server/nav/floor_view.hpp"

namespace seeker::explore {

/// Size of the known map.
struct MapSize {
  double walls_m = 0.0;  ///< sum of the lengths of the walls
  std::size_t segments = 0;
  double floor_m2 = 0.0;  ///< area known to be free
};
/// `floor` may be null.
[[nodiscard]] MapSize size_of(const std::vector<MapSegment>& segments, const nav::FloorView* floor);

/// Detects traps. As in the paper, a trap is when no control promises a gain on several decisions in a row. It is also
/// a trap when controls promise a gain again and again and the map does not grow: then the predictions are wrong there,
/// and a robot that plans only one step ahead would oscillate for ever. Growth is measured against the largest map so
/// far, so that walls that appear and disappear do not count as growth.
class TrapWatch {
 public:
  explicit TrapWatch(const OneStepParams& params) : params_(params) {}

  /// Call after a decision; true: the robot is in a trap.
  [[nodiscard]] bool note(bool gains_nothing, const MapSize& size);
  /// Starts counting again; with `suspicious` the first decision without promised gain is a trap.
  void reset(bool suspicious = false);

 private:
  OneStepParams params_;
  MapSize largest_;
  int hopeless_ = 0;   ///< decisions in a row that promised no gain
  int fruitless_ = 0;  ///< decisions in a row that brought no gain
};

}  // namespace seeker::explore
