/// \file
/// Which key point of the right picture a key point of the left one is: the five constraints of spec S2.1.
#pragma once

#include <vector>

#include "server/vision/feature_match.hpp"
#include "server/vision/stereo_features.hpp"

namespace seeker::vision {

/// Pairs (left, right) that pass all constraints, in the order of `left`, one a place. Several features at one place
/// (Orientations::kAll) must follow each other; they do not make each other ambiguous. By counting
/// (params.paper_uniqueness) a left point with two right points that pass is dropped; else the pair must be each
/// other's best and clearly better than the second where there is one. `row_gate_px`: constraint (1), for key points of
/// coarser pixels wider than the parameter's.
[[nodiscard]] std::vector<FeatureMatch> match_stereo(const FeatureList& left, const FeatureList& right,
                                                     const StereoMatchParams& params, double row_gate_px);

}  // namespace seeker::vision
