/// \file
/// Precomputed data of a target's picture.
#pragma once

#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "server/vision/patch.hpp"
#include "server/vision/recogniser_params.hpp"
#include "server/vision/regions.hpp"

namespace seeker::vision {

/// A part of the target's picture that may appear as a region of the scene. The region's box gives the box of the whole
/// target.
struct Anchor {
  cv::Rect2d part;            ///< relative to the whole: (0, 0, 1, 1) is the whole picture
  double aspect = 1.0;        ///< width / height of the part in pixels
  std::optional<bool> light;  ///< class of the region; unset: either

  /// The whole target's box, given the box of a region that is this part.
  [[nodiscard]] cv::Rect2d whole(const cv::Rect& region) const;
  /// Whether a region's proportions fit within the tolerance and one pixel.
  [[nodiscard]] bool fits(const cv::Rect& region, double tolerance) const;
};

/// One variant of a target that is correlated.
struct TemplateVariant {
  std::vector<TemplatePatch> patches;  ///< from the smallest to the largest
  std::vector<Anchor> anchors;
  cv::Rect2d part{0.0, 0.0, 1.0, 1.0};  ///< part of the picture that the patches show

  /// The whole picture's box, given that of the part that the patches show.
  [[nodiscard]] cv::Rect2d whole(const cv::Rect2d& box) const;
  /// The largest patch that is not larger than the candidate; the smallest for yet smaller candidates.
  [[nodiscard]] const TemplatePatch& patch_for(const cv::Rect2d& box) const;
};

/// All variants of one target: always the whole picture; with `object_alone`, where the picture shows a textured object
/// on ground of one colour, also the object alone, since its background differs in a scene.
struct TargetTemplate {
  int target = 0;
  double height_m = 0.0;
  std::vector<TemplateVariant> variants;
};

/// `grey` must not be empty or of one colour (check_target()).
[[nodiscard]] TargetTemplate make_target_template(const cv::Mat& grey, int target, double height_m,
                                                  const TemplateParams& params);

}  // namespace seeker::vision
