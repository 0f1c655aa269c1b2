/// \file
/// Association of features with landmarks while the pose is roughly known (spec S2.5 within the window of the
/// prediction), and the vote on which of these matches agree with each other.
#pragma once

#include <span>
#include <vector>

#include "server/localize/landmark_map.hpp"

namespace seeker::localize {

/// A landmark that should be visible in the frame, unless it is occluded.
struct ExpectedLandmark {
  std::size_t landmark = 0;  ///< index in the database
  Pixel pixel;               ///< predicted position in the picture
};

/// Landmarks within range and in the picture that were observed before from a similar direction. In the paper's mode
/// those within range and bearing, from any direction (spec S2.10); their pixel has the height of the eye.
[[nodiscard]] std::vector<ExpectedLandmark> expected_landmarks(const StereoGeometry& geometry, const LandmarkMap& map,
                                                               const EyeBelief& belief, const LocaliserParams& params);

/// Matches each feature with the most similar landmark in the window around its prediction, where they are mutually
/// nearest and no other landmark of the window is nearly as similar.
[[nodiscard]] std::vector<Pairing> match_in_windows(const StereoGeometry& geometry, const LandmarkMap& map,
                                                    const EyeBelief& belief,
                                                    std::span<const vision::StereoFeature> features,
                                                    std::span<const EyeFeature> lifted,
                                                    std::span<const ExpectedLandmark> expected,
                                                    const LocaliserParams& params);

/// The largest group of measurements within the gate that agree: a belief corrected by one of them alone must explain
/// the others (1-point RANSAC, Civera et al. 2010, with every match or `max_votes` of them). Returns their indices.
[[nodiscard]] std::vector<std::size_t> agreeing(const EyeBelief& belief, std::span<const RangeBearing> seen,
                                                const TrackingParams& params);

}  // namespace seeker::localize
