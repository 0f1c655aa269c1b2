/// \file
/// Recognition of targets by SIFT key points that agree on a homography: for textured targets, also rotated, oblique or
/// partly hidden ones. More expensive than template matching; chosen per target.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "server/vision/recogniser_params.hpp"
#include "server/vision/scene_view.hpp"
#include "server/vision/sift_features.hpp"
#include "server/vision/sighting.hpp"

namespace seeker::vision {

/// Recognises all targets by one detection in the scene, with at most one sighting per target and picture.
class FeatureRecogniser : public Recogniser {
 public:
  /// Takes those of `targets` that are of kind kFeature. Fails with kInvalidArgument when a picture has too few key
  /// points.
  [[nodiscard]] static Result<std::unique_ptr<FeatureRecogniser>> make(const std::vector<TargetModel>& targets,
                                                                       const RecogniserParams& params);

  [[nodiscard]] Result<RecognitionReport> recognise(const Image& picture) const override;
  [[nodiscard]] Result<std::vector<StageImage>> explain(const Image& picture) const override;

 private:
  struct Known {
    int target = 0;
    double height_m = 0.0;
    cv::Size size;
    FeatureList features;
  };

  explicit FeatureRecogniser(const RecogniserParams& params) : params_(params), view_(params.view) {}
  void match_target(const Known& known, const FeatureList& scene, const cv::Size& working,
                    RecognitionReport& report) const;

  RecogniserParams params_;
  SceneView view_;
  std::vector<Known> targets_;
};

}  // namespace seeker::vision
