/// \file
/// Valid maps of segments for tests of files, streams and exports.
#pragma once

#include <cstddef>

#include "common/core/line_map.hpp"
#include "common/core/rng.hpp"

namespace seeker::testing {

struct RandomMapSize {
  std::size_t nodes = 4;
  std::size_t segments = 40;
  std::size_t keyframes = 6;
  std::size_t beams = 31;
};

/// Arbitrary but valid: positive semi-definite covariances, known nodes, ids that were given out, odd numbers.
[[nodiscard]] LineMap random_map(Rng& rng, const RandomMapSize& size = {});

/// A rectangular room of four walls around the origin, ids 1 to 4, with real ends, one node and one kept scan.
[[nodiscard]] LineMap room_map(double width_m = 8.0, double depth_m = 5.0);

}  // namespace seeker::testing
