/// \file
/// The place of one stereo frame in the whole database, without a guess: where a robot wakes up, or was carried to.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "common/core/rng.hpp"
#include "server/localize/landmark_map.hpp"

namespace seeker::localize {

enum class RelocaliseVerdict : std::uint8_t {
  kFound,
  kNothing,    ///< too few features agree on a place
  kAmbiguous,  ///< more than one place explains the frame about as well: repeated structure
  kVague,      ///< the matches lie too close together in the picture, or leave the place uncertain, or all but one do
};
[[nodiscard]] std::string_view to_string(RelocaliseVerdict verdict);

struct RelocaliseAnswer {
  RelocaliseVerdict verdict = RelocaliseVerdict::kNothing;
  std::string reason;            ///< one sentence with the figures
  EyeBelief belief;              ///< best place; only to be used where kFound
  std::vector<Pairing> inliers;  ///< points are indices of the lifted features
  int candidates = 0;            ///< matches that were voted on
  double likeness = 0.0;         ///< of the inliers, RelocaliseParams::min_likeness
  int cells = 0;                 ///< of the picture, with an inlier
  int rival_inliers = 0;         ///< of the best other place
};

/// All features against all landmarks, pairs of matches give places (exact in the plane with stereo), matches vote.
[[nodiscard]] RelocaliseAnswer relocalise(const StereoGeometry& geometry, const LandmarkMap& map,
                                          std::span<const vision::StereoFeature> features,
                                          std::span<const EyeFeature> lifted, const LocaliserParams& params, Rng& rng);

}  // namespace seeker::localize
