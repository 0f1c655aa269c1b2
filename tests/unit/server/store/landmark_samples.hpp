/// \file
/// Databases of landmarks with made-up numbers.
#pragma once

#include "common/core/rng.hpp"
#include "server/store/landmark_file.hpp"

namespace seeker::testing {

inline store::LandmarkContent some_landmarks(std::uint64_t seed, std::size_t count) {
  Rng rng(seed);
  store::LandmarkContent content;
  content.calibration = rng.bits();
  content.next_id = 2 * count + 1;
  content.sightings = rng.below(1000);
  for (std::size_t n = 0; n < count; ++n) {
    store::LandmarkRecord& landmark = content.landmarks.emplace_back();
    landmark.id = 2 * n + 1;
    landmark.p_map = {rng.uniform(-9, 9), rng.uniform(-9, 9), rng.uniform(0, 2)};
    landmark.information = {400.0, 1.0, 2.0, 300.0, 3.0, 200.0};
    landmark.to_eye = {1.0, 0.0, 0.0};
    landmark.concentration = rng.uniform();
    landmark.scale_m = rng.uniform(0.01, 0.2);
    landmark.log_odds = rng.uniform(-3, 3);
    landmark.seen = static_cast<std::int64_t>(rng.below(40)) + 1;
    landmark.expected = landmark.seen + static_cast<std::int64_t>(rng.below(9));
    landmark.misses = static_cast<std::int64_t>(rng.below(4));
    landmark.last_seen = rng.below(1000);
    for (std::size_t k = 0; k <= rng.below(4); ++k) {
      store::LandmarkSide& side = landmark.sides.emplace_back();
      side.to_eye = {0.0, 1.0, 0.0};
      side.seen = static_cast<std::int64_t>(k) + 1;
      for (std::uint8_t& byte : side.descriptor) {
        byte = static_cast<std::uint8_t>(rng.below(256));
      }
    }
  }
  return content;
}

}  // namespace seeker::testing
