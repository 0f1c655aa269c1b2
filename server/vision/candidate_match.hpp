/// \file
/// Stage 3 of spec S3.4 for one candidate: correlation with jitter, refinement, gradient check.
#pragma once

#include <opencv2/core.hpp>

#include "server/vision/target_template.hpp"

namespace seeker::vision {

/// Result of a candidate.
enum class MatchOutcome : std::uint8_t { kAccepted, kRejectedNcc, kRejectedVerify };

struct CandidateMatch {
  MatchOutcome outcome = MatchOutcome::kRejectedNcc;
  cv::Rect2d box;  ///< box after the refinement
  double ncc = 0.0;
  double gradient_ncc = 0.0;
};

/// Correlates the target around the supposed box: a grid of shifts and scales with the smallest patch, then, where that
/// is promising, step-wise refinement (`refine`) of position and size with the patch that suits the candidate, then the
/// gradient check.
[[nodiscard]] CandidateMatch match_candidate(const GreyPyramid& scene, const TemplateVariant& variant,
                                             const cv::Rect2d& supposed, const TemplateParams& params);

}  // namespace seeker::vision
