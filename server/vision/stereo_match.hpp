/// \file
/// Stereo matching of key points under the five constraints of spec S2.1.
#pragma once

#include <vector>

#include "server/vision/feature_match.hpp"
#include "server/vision/stereo_features.hpp"

namespace seeker::vision {

/// Pairs that match by their descriptors alone, before the constraints (spec S2.11, Table 1): mutually best within the
/// gates, or by best-bin-first search, as in the paper, the right point nearest to each left one.
[[nodiscard]] std::vector<FeatureMatch> match_by_descriptor(const FeatureList& left, const FeatureList& right,
                                                            const StereoMatchParams& params);

/// Pairs (left, right) that pass all constraints, in the order of `left`, one per position. Several features at one
/// position (Orientations::kAll) must be consecutive; they are not ambiguous with each other. By counting
/// (params.paper_uniqueness) a left point with two accepted right points is dropped; otherwise the pair must be
/// mutually best and clearly better than the second best where there is one. With params.bbf_leaves only right points
/// that best-bin-first search examines are candidates. `row_gate_px` is the gate of constraint (1), which for key
/// points of coarser pixels is wider than the parameter.
[[nodiscard]] std::vector<FeatureMatch> match_stereo(const FeatureList& left, const FeatureList& right,
                                                     const StereoMatchParams& params, double row_gate_px);

}  // namespace seeker::vision
