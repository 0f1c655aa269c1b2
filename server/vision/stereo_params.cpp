#include <array>

#include "server/vision/bbf_tree.hpp"
#include "server/vision/bounds.hpp"
#include "server/vision/stereo_features.hpp"

namespace seeker::vision {

StereoFeatureParams paper_stereo_params() {
  StereoFeatureParams params;
  params.detector.kind = DescriptorKind::kSift;
  params.match.min_disparity_px = 0.0;
  params.match.max_disparity_px = 20.0;
  params.match.scale_gate_kind = ScaleGate::kDifference;
  params.match.scale_gate = 1.5;
  params.match.metric = Metric::kL1;
  params.match.max_distance = 3.5;
  params.match.paper_uniqueness = true;
  params.match.bbf_leaves = kPaperLeaves;
  params.match.refine_disparity = false;
  return params;
}

Status validate(const StereoFeatureParams& params) {
  if (Status detector = validate(params.detector); !detector) {
    return detector;
  }
  const StereoMatchParams& m = params.match;
  if (!(m.min_disparity_px < m.max_disparity_px)) {
    return fail(Errc::kInvalidArgument, "match.min_disparity_px must be below match.max_disparity_px");
  }
  return check_bounds(std::array<Bound, 8>{{{"match.max_row_offset_px", m.max_row_offset_px, 0.1, 20.0},
                                            {"match.min_disparity_px", m.min_disparity_px, 0.0, 1000.0},
                                            {"match.max_disparity_px", m.max_disparity_px, 1.0, 4096.0},
                                            {"match.max_rotation_rad", m.max_rotation_rad, 0.01, kPi},
                                            {"match.scale_gate", m.scale_gate, 0.1, 100.0},
                                            {"match.max_distance", m.max_distance, 0.01, 20.0},
                                            {"match.max_ratio", m.max_ratio, 0.1, 1.0},
                                            {"match.bbf_leaves", static_cast<double>(m.bbf_leaves), 0.0, 1e6}}});
}

}  // namespace seeker::vision
