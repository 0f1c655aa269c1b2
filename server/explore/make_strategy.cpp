#include "server/explore/make_strategy.hpp"

#include "common/core/assert.hpp"
#include "server/explore/active_strategy.hpp"
#include "server/explore/place_strategy.hpp"
#include "server/explore/roam.hpp"

namespace seeker::explore {

namespace {

std::unique_ptr<ExploreStrategy> tour_strategy(ExploreParams params) {
  params.driver.follower.max_v_m_s = params.tour.max_v_m_s;
  params.driver.follower.rotate_in_place_rad = params.tour.rotate_in_place_rad;
  return std::make_unique<PlaceStrategy>(params, make_tour_chooser(params));
}

}  // namespace

std::unique_ptr<ExploreStrategy> make_strategy(Strategy strategy, const ExploreParams& params) {
  switch (strategy) {
    case Strategy::kActive: return std::make_unique<ActiveStrategy>(params);
    case Strategy::kTour: return tour_strategy(params);
    case Strategy::kRoam: return std::make_unique<RoamStrategy>(params.roam, params.driver.follower.clearance);
    case Strategy::kFrontier: return std::make_unique<PlaceStrategy>(params, make_frontier_chooser(params));
    case Strategy::kGain: return std::make_unique<PlaceStrategy>(params, make_gain_chooser(params));
    case Strategy::kHorizon: return std::make_unique<PlaceStrategy>(params, make_horizon_chooser(params));
  }
  SEEKER_ASSERT(false);
  return nullptr;
}

StrategyMaker maker_of(Strategy strategy) {
  return [strategy](const ExploreParams& params) { return make_strategy(strategy, params); };
}

}  // namespace seeker::explore
