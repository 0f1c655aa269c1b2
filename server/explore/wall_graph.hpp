/// \file
/// Paths along mapped walls to their open ends: the navigation cost of wall following (spec S1.12, step 1).
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "common/core/line_map.hpp"

namespace seeker::explore {

/// Direction of wall following: left keeps the wall on the robot's right hand (counter-clockwise in a room), towards
/// left ends.
enum class WallSide : std::uint8_t { kLeft, kRight };

[[nodiscard]] bool is_real(const MapSegment& segment, WallSide side);
[[nodiscard]] Point2 end_of(const MapSegment& segment, WallSide side);
[[nodiscard]] constexpr WallSide opposite(WallSide side) {
  return side == WallSide::kLeft ? WallSide::kRight : WallSide::kLeft;
}
/// Direction of travel along the segment's x axis.
[[nodiscard]] constexpr double sign_of(WallSide side) { return side == WallSide::kLeft ? -1.0 : 1.0; }

/// A path along walls: over the ends ahead of segments, and over gaps to the adjacent segments.
struct WallRoute {
  double cost_m = 0.0;
  std::vector<std::size_t> segments;  ///< in the order of travel, from the first segment to the one whose end is open
};

/// The segment whose near end lies closest to the end ahead of segment `from`, within `adjacency_m`. Only an end that
/// continues the path counts: a right one after a left one.
[[nodiscard]] std::optional<std::size_t> adjacent_segment(const std::vector<MapSegment>& segments, std::size_t from,
                                                          WallSide side, double adjacency_m);

/// The shortest path from x = `along_m` of segment `from` to the first virtual end in that direction. Nothing: there is
/// none (the paper's infinite cost).
[[nodiscard]] std::optional<WallRoute> route_to_open_end(const std::vector<MapSegment>& segments, std::size_t from,
                                                         double along_m, WallSide side, double adjacency_m);

}  // namespace seeker::explore
