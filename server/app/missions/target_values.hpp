/// \file
/// Targets and detections between the client's values and those of vision and search.
#pragma once

#include <string>
#include <vector>

#include "common/api/mission.hpp"
#include "common/api/perception.hpp"
#include "server/search/search_types.hpp"
#include "server/vision/sighting.hpp"

namespace seeker::app {

[[nodiscard]] std::vector<vision::TargetModel> target_models(const std::vector<api::TargetSpec>& targets);
[[nodiscard]] std::vector<search::SearchTarget> search_targets(const std::vector<api::TargetSpec>& targets);
/// `targets` are those of the mission.
[[nodiscard]] api::Detection to_api(const search::Detection& detection,
                                    const std::vector<search::SearchTarget>& targets);

}  // namespace seeker::app
