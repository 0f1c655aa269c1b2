/// \file
/// Figures of the search paper that need no run.
#pragma once

#include <filesystem>

#include "common/core/result.hpp"
#include "server/app/composition/robot_options.hpp"
#include "server/lab/search/search_run.hpp"

namespace seeker::lab {

/// Fig 3: the membership functions of distances, target bearing and heading change (spec S3.2).
[[nodiscard]] Image membership_figure();

/// A picture of the simulated camera with the world's target `range_m` away under `bearing_rad`, the robot standing
/// where there is room in front of the target.
[[nodiscard]] Result<Image> picture_of_target(const RunSpec& spec, double range_m, double bearing_rad);

/// Fig 4: the stages of dynamic template matching of one simulated picture; `NN_stage.png` of each into `folder`.
[[nodiscard]] Result<Image> stages_figure(const RunSpec& spec, const std::filesystem::path& folder);

}  // namespace seeker::lab
