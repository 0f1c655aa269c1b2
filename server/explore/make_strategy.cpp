#include "server/explore/make_strategy.hpp"

#include <string>

#include "server/explore/active_strategy.hpp"
#include "server/explore/place_strategy.hpp"
#include "server/explore/roam.hpp"

namespace seeker::explore {

Result<std::unique_ptr<ExploreStrategy>> make_strategy(Strategy strategy, const ExploreParams& params) {
  switch (strategy) {
    case Strategy::kActive: return std::make_unique<ActiveStrategy>(params);
    case Strategy::kRoam: return std::make_unique<RoamStrategy>(params.roam, params.driver.follower.clearance);
    case Strategy::kFrontier: return std::make_unique<PlaceStrategy>(params, make_frontier_chooser(params));
    case Strategy::kGain:
    case Strategy::kHorizon: break;
  }
  return fail(Errc::kNotReady, "this program has no strategy '" + std::string(to_string(strategy)) +
                                   "'; choose 'active', 'roam' or 'frontier'");
}

}  // namespace seeker::explore
