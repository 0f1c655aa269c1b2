#include "server/explore/make_strategy.hpp"

#include <string>

#include "server/explore/place_strategy.hpp"

namespace seeker::explore {

Result<std::unique_ptr<ExploreStrategy>> make_strategy(Strategy strategy, const ExploreParams& params) {
  switch (strategy) {
    case Strategy::kFrontier: return std::make_unique<PlaceStrategy>(params, make_frontier_chooser(params));
    case Strategy::kGain:
    case Strategy::kHorizon:
    case Strategy::kActive:
    case Strategy::kRoam: break;
  }
  return fail(Errc::kNotReady,
              "this program has no strategy '" + std::string(to_string(strategy)) + "'; choose 'frontier'");
}

}  // namespace seeker::explore
