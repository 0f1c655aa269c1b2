#include "server/explore/strategy.hpp"

#include "common/core/assert.hpp"

namespace seeker::explore {

std::string_view to_string(Strategy strategy) {
  switch (strategy) {
    case Strategy::kActive: return "active";
    case Strategy::kHorizon: return "horizon";
    case Strategy::kTour: return "tour";
    case Strategy::kRoam: return "roam";
    case Strategy::kFrontier: return "frontier";
    case Strategy::kGain: return "gain";
  }
  SEEKER_ASSERT(false);
  return "";
}

}  // namespace seeker::explore
