/// \file
/// The strategies by name.
#pragma once

#include <memory>

#include "common/core/result.hpp"
#include "server/explore/explore_params.hpp"
#include "server/explore/strategy.hpp"

namespace seeker::explore {

[[nodiscard]] Result<std::unique_ptr<ExploreStrategy>> make_strategy(Strategy strategy, const ExploreParams& params);

}  // namespace seeker::explore
