#include "server/app/missions/map_view_finder.hpp"

#include <utility>

#include "common/core/assert.hpp"

namespace seeker::app {

MapViewFinder::MapViewFinder(const explore::ExploreParams& params, nav::ForbiddenAreas areas)
    : params_(params),
      areas_(std::move(areas)),
      floors_(params.cost, areas_, params.floor_cell_m, params.map_period_s),
      openings_(params.viewpoints),
      segments_(seconds(params.segments_period_s)) {}

std::vector<Pose2> MapViewFinder::find(const Situation& situation) {
  SEEKER_ASSERT(situation.tracker != nullptr);
  const Pose2& map_T_base = situation.pose.map_T_base;
  floors_.attend(*situation.map, map_T_base, situation.now);
  const auto floor = floors_.view(true);
  const auto costs = floor ? nav::DistanceField::build((*floor)->cost, map_T_base.translation())
                           : Result<nav::DistanceField>(tl::unexpected<Error>(floor.error()));
  std::vector<Pose2> views;
  if (!costs) {
    return views;  // the search itself says that it cannot move
  }
  explore::OpeningsInput input{**floor, *costs,     segments_.of(*situation.tracker, situation.now),
                               areas_,  map_T_base, situation.now};
  input.seen_faces = false;  // a search looks too seldom to tell furniture from walls
  for (const explore::Opening& opening : openings_.find(input)) {
    if (opening.kind != explore::OpeningKind::kFrontier) {
      views.push_back(opening.map_T_view);
    }
  }
  return views;
}

void MapViewFinder::transform(const MapMove& move) {
  openings_.transform(move);
  floors_.transform(move);
  segments_.forget();
}

}  // namespace seeker::app
