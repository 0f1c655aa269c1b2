#include "server/vision/stereo_features.hpp"

#include "server/vision/picture.hpp"
#include "server/vision/sift_features.hpp"
#include "server/vision/stereo_check.hpp"
#include "server/vision/stereo_match.hpp"
#include "server/vision/stereo_refine.hpp"

namespace seeker::vision {
namespace {

constexpr double kSureRatio = 0.8;

/// Orientations of one place follow each other.
int count_places(const FeatureList& features) {
  int places = 0;
  for (std::size_t i = 0; i < features.size(); ++i) {
    places += i == 0 || !same_place(features.keypoints[i], features.keypoints[i - 1]) ? 1 : 0;
  }
  return places;
}

class SiftStereoExtractor final : public StereoExtractor {
 public:
  SiftStereoExtractor(const StereoGeometry& geometry, const StereoFeatureParams& params)
      : geometry_(geometry), params_(params) {}

  [[nodiscard]] Result<StereoFeatures> extract(const StereoFrame& frame) const override;
  [[nodiscard]] Result<FeatureList> detect(const Image& picture) const override;

 private:
  [[nodiscard]] std::optional<StereoFeature> measure(const cv::Mat& left, const cv::Mat& right, const Keypoint& l,
                                                     const Keypoint& r) const;
  [[nodiscard]] double row_gate_px() const {
    // Key points of pixels twice as wide are half as exact.
    return params_.match.max_row_offset_px * (params_.detector.half_resolution ? 2.0 : 1.0);
  }

  StereoGeometry geometry_;
  StereoFeatureParams params_;
};

/// Nothing where the pictures themselves do not correlate best near the match: four of five such matches are wrong.
std::optional<StereoFeature> SiftStereoExtractor::measure(const cv::Mat& left, const cv::Mat& right, const Keypoint& l,
                                                          const Keypoint& r) const {
  const StereoMatchParams& match = params_.match;
  StereoFeature feature{l, static_cast<double>(l.u_px) - static_cast<double>(r.u_px), {}};
  if (match.refine_disparity) {
    const auto refined = refine_disparity(left, right, l.u_px, l.v_px, feature.disparity_px);
    if (!refined) {
      return std::nullopt;
    }
    feature.disparity_px = refined->disparity_px;
  }
  if (!(feature.disparity_px > match.min_disparity_px && feature.disparity_px < match.max_disparity_px)) {
    return std::nullopt;
  }
  return feature;
}

Result<StereoFeatures> SiftStereoExtractor::extract(const StereoFrame& frame) const {
  if (Status ok = check_pictures(frame, geometry_); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  const cv::Mat left_grey = to_grey_mat(frame.left);
  const cv::Mat right_grey = to_grey_mat(frame.right);
  // One eye after the other: OpenCV's threads inside one detection are used better than one thread an eye, 145 against
  // 158 ms with two (vision.md 1.1).
  const FeatureList left = detect_sift(left_grey, params_.detector, Orientations::kAll);
  const FeatureList right = detect_sift(right_grey, params_.detector, Orientations::kAll);
  // The rig is checked by pairs that are certain by their descriptors alone, for any gates.
  const MatchParams sure{params_.match.metric, params_.match.max_distance, kSureRatio};
  const auto sure_pairs = match_mutually(left.descriptors, right.descriptors, sure);
  if (Status ok = check_pair(fault_of_pair(left, right, sure_pairs, row_gate_px())); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  const MatchParams alone{params_.match.metric, params_.match.max_distance, params_.match.max_ratio};
  const bool are_sure = alone == sure && params_.match.bbf_leaves == 0 && !params_.match.paper_uniqueness;
  const auto alike = are_sure ? sure_pairs : match_by_descriptor(left, right, params_.match);
  StereoFeatures found;
  found.left_keypoints = count_places(left);
  found.right_keypoints = count_places(right);
  found.before_constraints.reserve(alike.size());
  for (const FeatureMatch& m : alike) {
    found.before_constraints.push_back(
        {left.keypoints[static_cast<std::size_t>(m.first)], right.keypoints[static_cast<std::size_t>(m.second)]});
  }
  found.inliers_of_rows = count_on_rows(left, right, alike, row_gate_px());
  const std::vector<FeatureMatch> matches = match_stereo(left, right, params_.match, row_gate_px());
  found.features.reserve(matches.size());
  for (const FeatureMatch& m : matches) {
    const auto l = static_cast<std::size_t>(m.first);
    auto feature =
        measure(left_grey, right_grey, left.keypoints[l], right.keypoints[static_cast<std::size_t>(m.second)]);
    if (feature) {
      feature->descriptor = left.descriptors[l];
      found.features.push_back(*feature);
    }
  }
  return found;
}

Result<FeatureList> SiftStereoExtractor::detect(const Image& picture) const {
  if (picture.empty()) {
    return fail(Errc::kInvalidArgument, "the picture has no pixels: check the camera or the file");
  }
  return detect_sift(to_grey_mat(picture), params_.detector);
}

}  // namespace

std::unique_ptr<StereoExtractor> make_stereo_extractor(const StereoGeometry& geometry,
                                                       const StereoFeatureParams& params) {
  SEEKER_ASSERT(validate(geometry).has_value() && validate(params).has_value());
  return std::make_unique<SiftStereoExtractor>(geometry, params);
}

}  // namespace seeker::vision
