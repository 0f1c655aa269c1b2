/// \file
/// The strategies by name.
#pragma once

#include <memory>

#include "server/explore/explore_params.hpp"
#include "server/explore/strategy.hpp"

namespace seeker::explore {

/// The strategy object; never null.
[[nodiscard]] std::unique_ptr<ExploreStrategy> make_strategy(Strategy strategy, const ExploreParams& params);
[[nodiscard]] StrategyMaker maker_of(Strategy strategy);

}  // namespace seeker::explore
