/// \file
/// Figures of the stereo database paper that are drawn on camera pictures (spec S2.11: Figs 1, 7, 12).
#pragma once

#include <string>
#include <vector>

#include "common/core/stereo.hpp"
#include "server/vision/stereo_features.hpp"

namespace seeker::lab {

/// How a feature is marked on a picture.
enum class FeatureMark : std::uint8_t { kCircle, kCross, kSquare };

struct MarkedFeature {
  vision::Keypoint at;
  FeatureMark mark = FeatureMark::kCircle;
};

/// A picture of the left eye with marks.
struct MarkedView {
  std::string caption;
  Image picture;
  std::vector<MarkedFeature> features;
};

/// Fig 1: a pair of pictures side by side with lines between matching key points, before the constraints (above) and
/// after them (below).
[[nodiscard]] Image match_figure(const StereoFrame& pair, const vision::StereoFeatures& seen);

/// Figs 7, 12: views in two columns. Circles are green, crosses red, squares blue.
[[nodiscard]] Image marked_figure(const std::vector<MarkedView>& views);

}  // namespace seeker::lab
