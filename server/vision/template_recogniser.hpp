/// \file
/// Dynamic template matching, spec S3.4, for several targets at once.
#pragma once

#include <utility>
#include <vector>

#include <opencv2/core.hpp>

#include "server/vision/binarise.hpp"
#include "server/vision/recogniser_params.hpp"
#include "server/vision/scene_view.hpp"
#include "server/vision/sighting.hpp"
#include "server/vision/target_template.hpp"

namespace seeker::vision {

/// Preprocessing and regions are shared by all targets. Omnidirectional pictures are searched in their cylindrical
/// panorama (scene_view.hpp).
class TemplateRecogniser : public Recogniser {
 public:
  /// Takes those of `targets` that are of kind kTemplate. Pictures and parameters must have passed check_target() and
  /// validate(), as make_recogniser() ensures.
  TemplateRecogniser(const std::vector<TargetModel>& targets, const RecogniserParams& params);

  /// Fails also with kTooLarge when a target's picture is larger than this picture.
  [[nodiscard]] Result<RecognitionReport> recognise(const Image& picture) const override;
  [[nodiscard]] Result<std::vector<StageImage>> explain(const Image& picture) const override;

 private:
  /// The regions of all binarisations within the area limits and without duplicates.
  std::vector<Region> candidate_regions(const std::vector<Binarisation>& binarisations, double reference_area_px,
                                        StageCounts& stages) const;
  [[nodiscard]] bool area_fits(const Region& region, double reference_area_px) const;
  void match_target(const TargetTemplate& target, const std::vector<Region>& regions, const GreyPyramid& scene,
                    const cv::Size& working, RecognitionReport& report) const;
  void match_variant(const TargetTemplate& target, const TemplateVariant& variant, const std::vector<Region>& regions,
                     const GreyPyramid& scene, const cv::Size& working, RecognitionReport& report) const;
  [[nodiscard]] Status check_pictures(const Image& picture) const;

  RecogniserParams params_;
  SceneView view_;
  std::vector<TargetTemplate> targets_;
  double smallest_part_ = 1.0;  ///< smallest share of a target's area that any anchor has
  int widest_px_ = 0;           ///< largest width of a target's picture
  int highest_px_ = 0;          ///< largest height of a target's picture
};

}  // namespace seeker::vision
