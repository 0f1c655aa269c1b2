#include "server/search/strategy.hpp"

namespace seeker::search {

std::vector<UnreachablePlace> CoverageStrategy::unreachable() const {
  std::vector<UnreachablePlace> places;
  places.reserve(lists().unreachable.size());
  for (const Point2& p_map : lists().unreachable) {
    places.push_back({p_map, UnreachableCause::kBlocked, 0.0, ""});
  }
  return places;
}

}  // namespace seeker::search
