#include "common/core/mapped_side.hpp"

#include <algorithm>
#include <iterator>

namespace seeker {

std::vector<MappedSide> sides_of(const std::vector<MapSegment>& segments) {
  std::vector<MappedSide> sides;
  sides.reserve(segments.size());
  std::transform(segments.begin(), segments.end(), std::back_inserter(sides), [](const MapSegment& segment) {
    return MappedSide{segment.left(), segment.right()};
  });
  return sides;
}

std::vector<MappedSide> moved(std::vector<MappedSide> sides, const Pose2& new_T_old) {
  for (MappedSide& side : sides) {
    side = {new_T_old * side.left_map, new_T_old * side.right_map};
  }
  return sides;
}

}  // namespace seeker
