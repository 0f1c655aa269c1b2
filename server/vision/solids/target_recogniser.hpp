/// \file
/// The factory of the missions' recognisers: targets of every kind, including solids.
#pragma once

#include <memory>
#include <vector>

#include "server/vision/multi_recogniser.hpp"
#include "server/vision/solids/solid_recogniser.hpp"

namespace seeker::vision {

/// As make_recogniser(), with solids recognised by the model `solids`. Fails with kRefused and the remedy when a target
/// is a solid and there is no model (null), or the camera is omnidirectional.
[[nodiscard]] Result<std::unique_ptr<Recogniser>> make_target_recogniser(const std::vector<TargetModel>& targets,
                                                                         const RecogniserParams& params,
                                                                         const SolidModel* solids);

}  // namespace seeker::vision
