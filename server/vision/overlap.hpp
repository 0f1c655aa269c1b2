/// \file
/// Selection among the sightings of one picture.
#pragma once

#include <vector>

#include "server/vision/sighting.hpp"

namespace seeker::vision {

/// Sorts by score, best first, and drops every sighting whose centre lies in a better one's box or vice versa. Returns
/// the number of dropped ones. The order of equal scores is that of the input.
int suppress_overlaps(std::vector<Sighting>& sightings);

/// Keeps the first sighting of each target: of a list that suppress_overlaps() has sorted, the best one. Returns the
/// number of dropped ones.
int keep_first_of_each_target(std::vector<Sighting>& sightings);

}  // namespace seeker::vision
