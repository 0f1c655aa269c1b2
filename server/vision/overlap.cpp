#include "server/vision/overlap.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace seeker::vision {
namespace {

bool holds_centre(const Sighting& outer, const Sighting& inner) {
  // Within half of the seen size, not within the enclosing box, which is larger than a rotated target.
  const double reach = 0.5 * std::max(outer.size.width_px, outer.size.height_px);
  return std::hypot(outer.u_px - inner.u_px, outer.v_px - inner.v_px) < reach;
}

}  // namespace

int suppress_overlaps(std::vector<Sighting>& sightings) {
  std::stable_sort(sightings.begin(), sightings.end(),
                   [](const Sighting& a, const Sighting& b) { return a.score > b.score; });
  std::vector<Sighting> kept;
  for (const Sighting& s : sightings) {
    const bool overlaps = std::any_of(kept.begin(), kept.end(),
                                      [&s](const Sighting& k) { return holds_centre(k, s) || holds_centre(s, k); });
    if (!overlaps) {
      kept.push_back(s);
    }
  }
  const int dropped = static_cast<int>(sightings.size() - kept.size());
  sightings = std::move(kept);
  return dropped;
}

int keep_first_of_each_target(std::vector<Sighting>& sightings) {
  std::set<int> seen;
  return static_cast<int>(
      std::erase_if(sightings, [&seen](const Sighting& sighting) { return !seen.insert(sighting.target).second; }));
}

}  // namespace seeker::vision
