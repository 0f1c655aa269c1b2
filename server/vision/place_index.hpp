/// \file
/// Place recognition by photographs of one robot (`seeker-lab revisit`): features are matched one to one, then checked
/// against the geometry of two views. Pictures of topology nodes: view_features.hpp.
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
  double max_epipolar_px = 2.0;   ///< distance of an inlier from its epipolar line, in either picture
  int min_inliers = 20;           ///< number of inliers below which places do not match
  double min_inlier_share = 0.3;  ///< share of the mutual matches
  double min_spread_px = 20.0;    ///< standard deviation of the inliers along and across, in either picture

  friend bool operator==(const PlaceParams&, const PlaceParams&) = default;
};

/// Fails with kInvalidArgument and the field's name.
[[nodiscard]] Status validate(const PlaceParams& params);
/// Parameters of the detector for place recognition: 400 key points, one per position.
[[nodiscard]] DetectorParams place_detector_params();

/// Evidence that two pictures show the same place.
struct PlaceEvidence {
  int matches = 0;                    ///< number of mutual matches
  std::vector<FeatureMatch> inliers;  ///< those that agree on one epipolar geometry, no feature twice

  friend bool operator==(const PlaceEvidence&, const PlaceEvidence&) = default;
};

/// Compares two pictures; no value where they do not show the same place, or not certainly. Deterministic. The
/// library's mask of inliers is not used: with many-to-one matches OpenCV 4.6 returned 579 of 15 (vision.md 1.4); here
/// matches are mutual and residuals are recomputed.
[[nodiscard]] std::optional<PlaceEvidence> compare_places(const FeatureList& first, const FeatureList& second,
                                                          const PlaceParams& params);

/// A picture of the index that shows the same place as another.
struct PlaceMatch {
  std::uint64_t id = 0;
  PlaceEvidence evidence;  ///< `first` of its inliers: features of the query

  friend bool operator==(const PlaceMatch&, const PlaceMatch&) = default;
};

/// Pictures (of one robot, or one per node of a fleet) by id.
class PlaceIndex {
 public:
  explicit PlaceIndex(const PlaceParams& params = {});

  /// Adds a picture, or replaces the one with this id.
  void add(std::uint64_t id, FeatureList features);
  [[nodiscard]] std::size_t size() const { return places_.size(); }

  /// The pictures that show the same place as `features`, most inliers first, then lowest id; at most `at_most`.
  /// `may_match` selects the ids that are compared; empty: all.
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
