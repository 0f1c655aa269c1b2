#include "server/app/missions/travelled_path.hpp"

#include <algorithm>
#include <utility>

namespace seeker::app {
namespace {

/// So near to a place the robot is back at it.
constexpr double kBackAt_m = TravelledPath::kSpacing_m / 2.0;

}  // namespace

void TravelledPath::note(const Point2& place_map) {
  if (!places_map_.empty() && (places_map_.back() - place_map).norm() < kSpacing_m) {
    return;
  }
  const auto again = std::find_if(places_map_.begin(), places_map_.end(),
                                  [&](const Point2& place) { return (place - place_map).norm() < kBackAt_m; });
  if (again != places_map_.end()) {
    places_map_.erase(again + 1, places_map_.end());
    return;
  }
  places_map_.push_back(place_map);
  if (places_map_.size() <= kMostPlaces) {
    return;
  }
  std::vector<Point2> kept;
  for (std::size_t i = 0; i < places_map_.size(); ++i) {
    if (i % 2 == 0 || i >= places_map_.size() / 2) {
      kept.push_back(places_map_[i]);
    }
  }
  places_map_ = std::move(kept);
}

void TravelledPath::move(const MapMove& move) {
  for (Point2& place : places_map_) {
    place = move * place;
  }
}

std::vector<Point2> TravelledPath::backwards(const Point2& here_map) const {
  std::vector<Point2> way(places_map_.rbegin(), places_map_.rend());
  const auto first = std::find_if(way.begin(), way.end(),
                                  [&](const Point2& place) { return (place - here_map).norm() >= kSpacing_m; });
  way.erase(way.begin(), first);
  return way;
}

}  // namespace seeker::app
