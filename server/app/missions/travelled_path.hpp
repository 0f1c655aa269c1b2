/// \file
/// TravelledPath remembers the path of a mission, so that the robot can drive it back.
#pragma once

#include <vector>

#include "common/core/map_move.hpp"
#include "common/core/pose2.hpp"

namespace seeker::app {

/// Thinned places in the frame `map`, without the loops in which the robot came back to a place. Of a long path every
/// second place of the older half is dropped.
class TravelledPath {
 public:
  void note(const Point2& place_map);
  /// The map was corrected: the places move with it.
  void move(const MapMove& move);
  /// From the newest place to the first, at most kMostPlaces; without those next to the robot, which is at `here_map`.
  [[nodiscard]] std::vector<Point2> backwards(const Point2& here_map) const;

  static constexpr std::size_t kMostPlaces = 256;
  static constexpr double kSpacing_m = 1.0;

 private:
  std::vector<Point2> places_map_;
};

}  // namespace seeker::app
