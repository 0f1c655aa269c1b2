/// \file
/// Predictions of the horizon planner for single viewpoints and for sequences of them.
#pragma once

#include <cstddef>
#include <vector>

#include "server/explore/coarse_paths.hpp"
#include "server/explore/objective.hpp"
#include "server/explore/place_strategy.hpp"

namespace seeker::explore {

/// One viewpoint and what would be observed from it.
struct HorizonView {
  Opening opening;
  double path_m = 0.0;    ///< path length from the robot
  double floor_m2 = 0.0;  ///< area of unknown floor in sight
  Growth growth;
  /// Indices of the views whose openings are well in view from here, including this one.
  std::vector<std::size_t> shows;
};

/// Expected, discounted growth at one end of a wall.
struct ExpectedEnd {
  std::size_t end = 0;  ///< index into SightScene::open_ends()
  double extension_m = 0.0;
  double becomes_real = 0.0;
};

/// A sequence of drives and their joint gain. Every gain is divided by the path length at which it is obtained (to the
/// power of weight_path), so that early gains count more.
struct HorizonSequence {
  std::vector<std::size_t> stops;    ///< indices into the views, in the order of driving
  std::vector<std::size_t> settled;  ///< indices of the views whose openings will have been observed
  double path_m = 0.0;               ///< path length of all drives
  double floor_m2 = 0.0;
  std::vector<ExpectedEnd> ends;  ///< each end once, at the view where its gain is largest
  double uncertainty = 0.0;       ///< U of eq (19) after the first drive
  Terms terms;
  double score = 0.0;

  [[nodiscard]] bool settles(std::size_t view) const;
};

[[nodiscard]] std::vector<HorizonView> horizon_views(const PlaceInput& input, const SightScene& scene,
                                                     const ExploreParams& params);

/// The sequence with one more drive. `path_m` is the path length from the last stop (or from the robot) to the view.
[[nodiscard]] HorizonSequence extended(const HorizonSequence& sequence, const std::vector<HorizonView>& views,
                                       std::size_t view, double path_m, double weight_path);

}  // namespace seeker::explore
