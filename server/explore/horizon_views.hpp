/// \file
/// What the horizon planner knows of each place it may drive to, and of sequences of them.
#pragma once

#include <cstddef>
#include <vector>

#include "server/explore/coarse_ways.hpp"
#include "server/explore/objective.hpp"
#include "server/explore/place_strategy.hpp"

namespace seeker::explore {

/// One place and what would be seen there.
struct HorizonView {
  Opening opening;
  double way_m = 0.0;     ///< from the robot
  double floor_m2 = 0.0;  ///< unknown floor in sight
  Growth growth;
  std::vector<std::size_t> shows;  ///< views whose openings are well in view from here, this one among them
};

/// What one end of a wall is expected to bring in a sequence, discounted.
struct ExpectedEnd {
  std::size_t end = 0;  ///< index into SightScene::open_ends()
  double extension_m = 0.0;
  double becomes_real = 0.0;
};

/// Drives one after the other, and what they bring together. Every gain is divided by the way until it is got (to the
/// power of weight_path): what comes soon counts more.
struct HorizonSequence {
  std::vector<std::size_t> stops;    ///< indices into the views
  std::vector<std::size_t> settled;  ///< views whose openings will have been looked at
  double way_m = 0.0;
  double floor_m2 = 0.0;
  std::vector<ExpectedEnd> ends;  ///< each once, where it brings most
  double uncertainty = 0.0;       ///< U of eq (19) after the first drive
  Terms terms;
  double score = 0.0;

  [[nodiscard]] bool settles(std::size_t view) const;
};

[[nodiscard]] std::vector<HorizonView> horizon_views(const PlaceInput& input, const SightScene& scene,
                                                     const ExploreParams& params);

/// One drive more; `way_m` from the last stop (or the robot) to it.
[[nodiscard]] HorizonSequence extended(const HorizonSequence& sequence, const std::vector<HorizonView>& views,
                                       std::size_t view, double way_m, double weight_path);

/// U of eq (19) at the end of the drive to a view: robot and walls predicted along the path, with a look about every
/// metre.
[[nodiscard]] double uncertainty_after(const PlaceInput& input, const Opening& opening, const SightScene& scene,
                                       const Belief& belief, const OneStepParams& params);

}  // namespace seeker::explore
