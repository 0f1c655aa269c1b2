/// \file
/// One place, one sighting.
#pragma once

#include <vector>

#include "server/vision/sighting.hpp"

namespace seeker::vision {

/// Sorts by score, best first, and drops every sighting whose centre lies in a better one's box or the reverse.
/// Returns how many were dropped. The order of equal scores is that of the input.
int suppress_overlaps(std::vector<Sighting>& sightings);

}  // namespace seeker::vision
