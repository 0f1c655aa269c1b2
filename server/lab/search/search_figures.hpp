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

/// A picture of the simulated camera with the world's target at `range_m` and `bearing_rad`; the robot stands where
/// there is room in front of the target.
[[nodiscard]] Result<Image> picture_of_target(const RunSpec& spec, double range_m, double bearing_rad);

/// Fig 4: the stages of dynamic template matching on one simulated picture; each stage is also written as
/// `NN_stage.png` into `folder`.
[[nodiscard]] Result<Image> stages_figure(const RunSpec& spec, const std::filesystem::path& folder);

}  // namespace seeker::lab
