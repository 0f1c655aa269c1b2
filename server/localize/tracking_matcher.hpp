/// \file
/// Which features of a frame are which landmarks while the pose is roughly known (spec S2.5 within the window of the
/// prediction), and which of these matches agree with each other.
#pragma once

#include <span>
#include <vector>

#include "server/localize/landmark_map.hpp"

namespace seeker::localize {

/// A landmark that the frame should show, if nothing stands before it.
struct ExpectedLandmark {
  std::size_t landmark = 0;  ///< index in the database
  Pixel pixel;               ///< where
};

/// In range, in the picture, and seen before from about this side.
[[nodiscard]] std::vector<ExpectedLandmark> expected_landmarks(const StereoGeometry& geometry, const LandmarkMap& map,
                                                               const EyeBelief& belief, const LocaliserParams& params);

/// Each feature's most alike landmark in the window around its prediction, where it is the landmark's most alike
/// feature too and no other landmark of the window is nearly as alike.
[[nodiscard]] std::vector<Pairing> match_in_windows(const StereoGeometry& geometry, const LandmarkMap& map,
                                                    const EyeBelief& belief,
                                                    std::span<const vision::StereoFeature> features,
                                                    std::span<const EyeFeature> lifted,
                                                    std::span<const ExpectedLandmark> expected,
                                                    const LocaliserParams& params);

/// Of measurements within the gate, those that the largest group agrees on: a belief corrected by one of them alone
/// must explain the others (1-point RANSAC, Civera et al. 2010, every match or `max_votes` of them asked). Indices.
[[nodiscard]] std::vector<std::size_t> agreeing(const EyeBelief& belief, std::span<const RangeBearing> seen,
                                                const TrackingParams& params);

}  // namespace seeker::localize
