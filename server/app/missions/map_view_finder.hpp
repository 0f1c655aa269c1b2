/// \file
/// Where a robot would have to stand to see how the open walls of its map go on.
#pragma once

#include <vector>

#include "common/core/map_move.hpp"
#include "server/app/maps/segment_view.hpp"
#include "server/app/missions/behaviour.hpp"
#include "server/explore/explore_params.hpp"
#include "server/explore/openings.hpp"

namespace seeker::app {

/// Remembers openings that were observed in vain, as an exploration does.
class MapViewFinder {
 public:
  MapViewFinder(const explore::ExploreParams& params, nav::ForbiddenAreas areas);

  /// Frame `map`, the cheapest path first. Costs a plan of the whole map: for when a goal is chosen.
  [[nodiscard]] std::vector<Pose2> find(const Situation& situation);
  void transform(const MapMove& move);

 private:
  explore::ExploreParams params_;
  nav::ForbiddenAreas areas_;
  nav::FloorSource floors_;
  explore::Openings openings_;
  SegmentView segments_;
};

}  // namespace seeker::app
