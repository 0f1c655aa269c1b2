/// \file
/// SIFT features of a picture with the bearings at which the robot saw them: what is kept with a node of its topology
/// (spec S4.2, S4.5), with any kind of camera.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "common/core/image.hpp"
#include "common/core/result.hpp"
#include "server/vision/descriptor.hpp"
#include "server/vision/detector_params.hpp"
#include "server/vision/feature_match.hpp"
#include "server/vision/scene_view.hpp"

namespace seeker::vision {

/// Features of one picture: descriptors[i] was seen at bearings_rad[i], frame `base`, left positive.
struct ViewFeatures {
  std::vector<float> bearings_rad;
  std::vector<Descriptor> descriptors;

  [[nodiscard]] std::size_t size() const { return descriptors.size(); }
  friend bool operator==(const ViewFeatures&, const ViewFeatures&) = default;
};

/// Finds the features of a picture. The same picture gives the same features: no state, no random numbers. Thread-safe.
class ViewFeatureExtractor {
 public:
  /// Requires valid parameters (asserted).
  ViewFeatureExtractor(const ViewParams& view, const DetectorParams& detector);

  /// Features of the working picture: an omnidirectional picture is unwrapped first, so that an upright object looks
  /// alike at any bearing. Fails with kInvalidArgument when the picture is empty or has not the calibrated size.
  [[nodiscard]] Result<ViewFeatures> extract(const Image& picture) const;

 private:
  SceneView view_;
  DetectorParams detector_;
};

/// Limits of the similarity of two views.
struct ViewMatchParams {
  /// Spec S4.5 [J]: ratio test and mutual matches.
  MatchParams match{Metric::kL2, 2.0, 0.8};
  int min_matches = 20;     ///< number of mutual matches
  double min_share = 0.15;  ///< mutual matches as a share of the smaller set of features
  /// Beyond the paper: matches that agree on the rotation between the two headings, as a share of the matches and as a
  /// number; 0 and 0: not asked for.
  double min_agreement = 0.5;
  int min_agreeing = 12;
  double max_parallax_rad = 0.35;  ///< half the width of the interval of rotations that agree

  friend bool operator==(const ViewMatchParams&, const ViewMatchParams&) = default;
};

/// Fails with kInvalidArgument and the field's name.
[[nodiscard]] Status validate(const ViewMatchParams& params);

/// Evidence that two views show the same surroundings.
struct ViewMatch {
  int matches = 0;   ///< number of mutual matches
  int agreeing = 0;  ///< number of those that agree on the rotation
  /// Heading of the second view in the frame of the first: the middle of the bearings' differences that agree.
  double rotation_rad = 0.0;

  friend bool operator==(const ViewMatch&, const ViewMatch&) = default;
};

/// Compares two views (spec S4.5); no value where they are not similar. Deterministic.
[[nodiscard]] std::optional<ViewMatch> match_views(const ViewFeatures& first, const ViewFeatures& second,
                                                   const ViewMatchParams& params);

}  // namespace seeker::vision
