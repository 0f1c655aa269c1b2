/// \file
/// The factory of missions: targets of every kind, solids among them.
#pragma once

#include <memory>
#include <vector>

#include "server/vision/multi_recogniser.hpp"
#include "server/vision/solids/solid_recogniser.hpp"

namespace seeker::vision {

/// As make_recogniser(), with solids told by `solids`. kRefused with the remedy: a target is a solid, and there is no
/// model (null), or the camera is omnidirectional.
[[nodiscard]] Result<std::unique_ptr<Recogniser>> make_target_recogniser(const std::vector<TargetModel>& targets,
                                                                         const RecogniserParams& params,
                                                                         const SolidModel* solids);

}  // namespace seeker::vision
