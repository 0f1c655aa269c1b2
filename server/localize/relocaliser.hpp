/// \file
/// Global relocalisation of one stereo frame in the whole database, for a robot that was switched on or carried
/// elsewhere.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "common/core/rng.hpp"
#include "server/localize/landmark_map.hpp"

namespace seeker::localize {

enum class RelocaliseVerdict : std::uint8_t {
  kFound,
  kNothing,    ///< too few features agree on a pose
  kAmbiguous,  ///< more than one pose explains the frame about as well: repeated structure
  kVague,      ///< the matches are too close together in the picture, or leave the pose uncertain, or all but one do
};
[[nodiscard]] std::string_view to_string(RelocaliseVerdict verdict);

struct RelocaliseAnswer {
  RelocaliseVerdict verdict = RelocaliseVerdict::kNothing;
  std::string reason;            ///< one sentence with the evidence
  EyeBelief belief;              ///< best pose, of the inliers; to be believed for kFound alone
  std::vector<Pairing> inliers;  ///< points are indices of the lifted features
  int candidates = 0;            ///< number of matches that voted
  double likeness = 0.0;         ///< sum over the inliers, RelocaliseParams::min_likeness
  int cells = 0;                 ///< number of cells of the picture with an inlier
  int rival_inliers = 0;         ///< inliers of the best other pose
};

/// Matches all features against all landmarks; pairs of matches propose poses (exact in the plane with stereo), and
/// matches vote.
[[nodiscard]] RelocaliseAnswer relocalise(const StereoGeometry& geometry, const LandmarkMap& map,
                                          std::span<const vision::StereoFeature> features,
                                          std::span<const EyeFeature> lifted, const LocaliserParams& params, Rng& rng);

}  // namespace seeker::localize
