#include "server/options/vision_options.hpp"

#include <algorithm>
#include <vector>

namespace seeker::vision {

void describe(config::Fields& f, OmniCameraParams& params) {
  f.field("width_px", params.width_px);
  f.field("height_px", params.height_px);
  f.field("u0_px", params.u0_px);
  f.field("v0_px", params.v0_px);
  f.field("inner_radius_px", params.inner_radius_px);
  f.field("outer_radius_px", params.outer_radius_px);
  f.field("affine_c", params.affine_c);
  f.field("affine_d", params.affine_d);
  f.field("affine_e", params.affine_e);
  f.angle_deg("alignment_deg", params.alignment_rad);
  f.angle_deg("alignment_sigma_deg", params.alignment_sigma_rad);
  f.field("camera_height_m", params.camera_height_m);
  f.field("reference_radius_px", params.reference_radius_px);
  std::vector<double> coefficients(params.elevation_coefficients.begin(), params.elevation_coefficients.end());
  f.field("elevation_coefficients", coefficients);
  const bool complete = coefficients.size() == params.elevation_coefficients.size();
  f.check("elevation_coefficients", complete, "needs four numbers");
  if (complete) {
    std::copy(coefficients.begin(), coefficients.end(), params.elevation_coefficients.begin());
  }
}

void describe(config::Fields& f, ViewParams& params) {
  f.optional_section("omni", params.omni);
  f.angle_deg("photo_fov_deg", params.photo_fov_rad);
  f.angle_deg("photo_tilt_deg", params.photo_tilt_rad);
  f.field("photo_height_m", params.photo_height_m);
  f.field("panorama_scale", params.panorama_scale);
  f.angle_deg("min_elevation_deg", params.min_elevation_rad);
}

void describe(config::Fields& f, TemplateParams& params) {
  f.field("stretch_low", params.stretch_low);
  f.field("stretch_high", params.stretch_high);
  f.field("min_area", params.min_area);
  f.field("max_area", params.max_area);
  f.field("aspect_tolerance", params.aspect_tolerance);
  f.field("accept_ncc", params.accept_ncc);
  f.field("accept_gradient_ncc", params.accept_gradient_ncc);
  f.field("accept_gradient_ncc_large", params.accept_gradient_ncc_large);
  f.field("plain_shape_margin", params.plain_shape_margin);
  f.field("position_jitter_px", params.position_jitter_px);
  f.field("scale_jitter", params.scale_jitter);
  f.field("min_contrast", params.min_contrast);
  f.field("adaptive_block_px", params.adaptive_block_px);
  f.field("adaptive_offset", params.adaptive_offset);
  f.field("extra_binarisations", params.extra_binarisations);
  f.field("inner_anchors", params.inner_anchors);
  f.field("object_alone", params.object_alone);
  f.field("refine", params.refine);
  f.field("only_best", params.only_best);
}

void describe(config::Fields& f, FeatureParams& params) {
  f.field("max_features", params.max_features);
  f.field("contrast_threshold", params.contrast_threshold);
  f.field("wanted_features", params.wanted_features);
  f.field("ratio", params.ratio);
  f.field("reprojection_px", params.reprojection_px);
  f.field("min_inliers", params.min_inliers);
  f.field("min_inlier_share", params.min_inlier_share);
  f.field("max_scale_change", params.max_scale_change);
}

void describe(config::Fields& f, RecogniserParams& params) {
  f.section("view", params.view);
  f.section("templates", params.templates);
  f.section("features", params.features);
}

}  // namespace seeker::vision
