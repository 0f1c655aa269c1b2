/// \file
/// What a drive to a place will do to the certainty of robot and map, predicted along its path.
#pragma once

#include "server/explore/objective.hpp"
#include "server/explore/place_strategy.hpp"

namespace seeker::explore {

struct LegForecast {
  double uncertainty = 0.0;    ///< U of eq (19) of robot and map after the drive
  double worst_sigma_m = 0.0;  ///< largest standard deviation of the position on the path, in its worst direction
};

/// The walls that the legs of a decision may show; valid as long as `input`.
[[nodiscard]] SightScene forecast_scene(const PlaceInput& input, const OneStepParams& params);
/// Robot and walls as they are known before a leg.
[[nodiscard]] Belief forecast_belief(const StrategyInput& robot, const OneStepParams& params);

/// Predicts the drive along the planned path to the viewpoint, with a look every metre or so.
[[nodiscard]] LegForecast forecast_leg(const PlaceInput& input, const Opening& opening, const SightScene& scene,
                                       const Belief& belief, const OneStepParams& params);

/// The same without any look on the path: a bound that is quickly found. Only `worst_sigma_m` is meaningful.
[[nodiscard]] LegForecast forecast_blind_leg(const PlaceInput& input, const Opening& opening,
                                             const OneStepParams& params);

}  // namespace seeker::explore
