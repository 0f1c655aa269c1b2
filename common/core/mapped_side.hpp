/// \file
/// Sides of walls that a robot has mapped, in the form in which robots of a fleet exchange them.
#pragma once

#include <memory>
#include <vector>

#include "common/core/line_map.hpp"
#include "common/core/pose2.hpp"

namespace seeker {

/// One side of a wall, from its left to its right end as seen from the free space before it; frame `map`.
struct MappedSide {
  Point2 left_map = Point2::Zero();
  Point2 right_map = Point2::Zero();

  friend bool operator==(const MappedSide&, const MappedSide&) = default;
};

/// Sides that several holders share without copying; null: none.
using SharedSides = std::shared_ptr<const std::vector<MappedSide>>;

[[nodiscard]] std::vector<MappedSide> sides_of(const std::vector<MapSegment>& segments);
/// The same sides in another frame.
[[nodiscard]] std::vector<MappedSide> moved(std::vector<MappedSide> sides, const Pose2& new_T_old);

}  // namespace seeker
