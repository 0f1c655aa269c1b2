/// \file
/// Which pictures show the same place: features matched one to one, then checked against the geometry of two views.
/// For photographs of one robot (`seeker-lab revisit`) and for nodes of two robots' maps (spec S4).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "server/vision/descriptor.hpp"
#include "server/vision/detector_params.hpp"
#include "server/vision/feature_match.hpp"

namespace seeker::vision {

struct PlaceParams {
  MatchParams match{Metric::kL2, 0.7, 0.8};
  double max_epipolar_px = 2.0;   ///< of an inlier from its epipolar line, in either picture
  int min_inliers = 20;           ///< fewer are no place
  double min_inlier_share = 0.3;  ///< of the mutual matches
  double min_spread_px = 20.0;    ///< standard deviation of the inliers along and across, in either picture

  friend bool operator==(const PlaceParams&, const PlaceParams&) = default;
};

/// kInvalidArgument with the field's name.
[[nodiscard]] Status validate(const PlaceParams& params);
/// Key points as place recognition wants them: 400, one a place.
[[nodiscard]] DetectorParams place_detector_params();

/// Why two pictures are one place.
struct PlaceEvidence {
  int matches = 0;                    ///< mutual ones
  std::vector<FeatureMatch> inliers;  ///< those that agree on one epipolar geometry, no feature twice

  friend bool operator==(const PlaceEvidence&, const PlaceEvidence&) = default;
};

/// Nothing where the pictures do not show the same place, or not surely. Deterministic. The library's mask of inliers
/// is not believed: with many-to-one matches OpenCV 4.6 returned 579 of 15 (vision.md 1.4); matches are mutual and
/// residuals are counted here.
[[nodiscard]] std::optional<PlaceEvidence> compare_places(const FeatureList& first, const FeatureList& second,
                                                          const PlaceParams& params);

/// A picture of the index that shows the same place as another.
struct PlaceMatch {
  std::uint64_t id = 0;
  PlaceEvidence evidence;  ///< `first` of its inliers: features of the picture asked about

  friend bool operator==(const PlaceMatch&, const PlaceMatch&) = default;
};

/// Pictures (of one robot, or one node each of a fleet) by id.
class PlaceIndex {
 public:
  explicit PlaceIndex(const PlaceParams& params = {});

  /// Replaces what was there under this id.
  void add(std::uint64_t id, FeatureList features);
  [[nodiscard]] std::size_t size() const { return places_.size(); }

  /// The pictures that show the same place as `features`, most inliers first, then lowest id; at most `at_most`.
  /// `may_match`: ids to be looked at; empty: all.
  [[nodiscard]] std::vector<PlaceMatch> best_matches(const FeatureList& features, std::size_t at_most,
                                                     const std::function<bool(std::uint64_t)>& may_match = {}) const;

 private:
  struct Place {
    std::uint64_t id = 0;
    FeatureList features;
  };

  PlaceParams params_;
  std::vector<Place> places_;  ///< by id
};

}  // namespace seeker::vision
