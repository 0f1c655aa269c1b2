/// \file
/// Stereo features: SIFT key points in both eyes, matched under the five constraints of spec S2.1.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "common/core/angle.hpp"
#include "common/core/result.hpp"
#include "common/core/stereo.hpp"
#include "server/vision/descriptor.hpp"
#include "server/vision/detector_params.hpp"

namespace seeker::vision {

/// Criterion for the scales of two matching key points, spec S2.1 constraint (4).
enum class ScaleGate : std::uint8_t {
  kDifference,  ///< |sigma_l - sigma_r| < scale_gate, in pixels: as printed
  kRatio,       ///< the larger at most scale_gate times the smaller
};

/// The five constraints of spec S2.1.
struct StereoMatchParams {
  double max_row_offset_px = 1.0;              ///< (1)
  double min_disparity_px = 4.0;               ///< (2), exclusive
  double max_disparity_px = 200.0;             ///< (2), exclusive: 20 in the paper
  double max_rotation_rad = deg_to_rad(20.0);  ///< (3)
  ScaleGate scale_gate_kind = ScaleGate::kRatio;
  double scale_gate = 1.5;  ///< (4)
  Metric metric = Metric::kL2;
  /// Largest distance of unit descriptors that match. The default is calibrated: with RootSIFT and L2 it accepts as
  /// many wrong pairs as 3.5 does with SIFT and L1 (spec S2.1). Wrong pairs are key points of similar scale and
  /// orientation 40 rows apart. In five pairs of photographs with 1000 key points the gate of the same rate was 0.41 to
  /// 0.56, with a median of 0.455; for the 500 strongest of all pairs together 0.41. By the same count 0.25 to 0.46,
  /// with a median of 0.29, corresponds to 2.5 (spec S2.5).
  double max_distance = 0.43;
  bool paper_uniqueness =
      false;               ///< (5): drop a left point with more than one right point that passes (1)-(4) and the gate
  double max_ratio = 0.8;  ///< otherwise: best over second best distance, in either direction
  /// Number of leaves of a k-d tree that best-bin-first search examines for each left point, 200 in the paper (spec
  /// S2.1); 0: all right points of its rows are compared.
  int bbf_leaves = 0;
  bool refine_disparity = true;  ///< to a fraction of a pixel, by correlation around the match

  friend bool operator==(const StereoMatchParams&, const StereoMatchParams&) = default;
};

struct StereoFeatureParams {
  DetectorParams detector;
  StereoMatchParams match;

  friend bool operator==(const StereoFeatureParams&, const StereoFeatureParams&) = default;
};

/// The gates, the descriptor and the search of the paper (spec S2.1): SIFT, L1, scale as a difference, uniqueness by
/// counting, best-bin-first search, and disparities below 20 px, so that only points beyond 5.04 m are measured.
[[nodiscard]] StereoFeatureParams paper_stereo_params();
/// kInvalidArgument with the field's name.
[[nodiscard]] Status validate(const StereoFeatureParams& params);

/// Key points of the two pictures that match by their descriptors alone.
struct KeypointPair {
  Keypoint left;
  Keypoint right;

  friend bool operator==(const KeypointPair&, const KeypointPair&) = default;
};

/// Features of one pair, and the candidates they were chosen from.
struct StereoFeatures {
  std::vector<StereoFeature> features;
  int left_keypoints = 0;                        ///< number of positions in the left picture
  int right_keypoints = 0;                       ///< number of positions in the right picture
  std::vector<KeypointPair> before_constraints;  ///< match_by_descriptor(), spec S2.11 Table 1 and Fig 1
  int inliers_of_rows = 0;  ///< pairs of those that pass (1): a small share indicates a wrong calibration
};

/// Detects and matches features. Not thread-safe; the eyes are processed with as many threads as OpenCV is given.
class StereoExtractor {
 public:
  StereoExtractor() = default;
  StereoExtractor(const StereoExtractor&) = delete;
  StereoExtractor& operator=(const StereoExtractor&) = delete;
  virtual ~StereoExtractor() = default;

  /// Fails with kInvalidArgument, cause and remedy for pictures of another size than the geometry's, black, saturated
  /// or blurred pictures (naming the eye), swapped eyes, and pictures that are not of one moment or one calibration.
  [[nodiscard]] virtual Result<StereoFeatures> extract(const StereoFrame& frame) const = 0;
  /// Key points of one picture with the same detector, for place recognition.
  [[nodiscard]] virtual Result<FeatureList> detect(const Image& picture) const = 0;
};

/// Requires valid arguments (asserted).
[[nodiscard]] std::unique_ptr<StereoExtractor> make_stereo_extractor(const StereoGeometry& geometry,
                                                                     const StereoFeatureParams& params);

}  // namespace seeker::vision
