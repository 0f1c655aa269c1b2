#include "server/vision/recogniser_params.hpp"

#include <array>

#include "server/vision/bounds.hpp"

namespace seeker::vision {
namespace {

Status validate_view(const ViewParams& p) {
  if (p.omni) {
    if (Status omni = validate(*p.omni); !omni) {
      return omni;
    }
  }
  return check_bounds(std::array<Bound, 5>{{{"view.photo_fov_rad", p.photo_fov_rad, 0.01, 3.1},
                                            {"view.photo_tilt_rad", p.photo_tilt_rad, -1.5, 1.5},
                                            {"view.photo_height_m", p.photo_height_m, 0.0, 100.0},
                                            {"view.panorama_scale", p.panorama_scale, 0.1, 3.0},
                                            {"view.min_elevation_rad", p.min_elevation_rad, -1.4, 0.0}}});
}

Status validate_templates(const TemplateParams& p) {
  if (!(p.stretch_low < p.stretch_high) || !(p.min_area < p.max_area)) {
    return fail(Errc::kInvalidArgument,
                "templates: stretch_low must be below stretch_high, and min_area below max_area");
  }
  if (p.adaptive_block_px % 2 == 0) {
    return fail(Errc::kInvalidArgument, "templates.adaptive_block_px must be odd");
  }
  return check_bounds(
      std::array<Bound, 14>{{{"templates.stretch_low", p.stretch_low, 0.0, 1.0},
                             {"templates.stretch_high", p.stretch_high, 0.0, 1.0},
                             {"templates.min_area", p.min_area, 0.0, 1.0},
                             {"templates.max_area", p.max_area, 0.0, 1.0},
                             {"templates.aspect_tolerance", p.aspect_tolerance, 0.0, 1.0},
                             {"templates.accept_ncc", p.accept_ncc, 0.1, 1.0},
                             {"templates.accept_gradient_ncc", p.accept_gradient_ncc, 0.0, 1.0},
                             {"templates.accept_gradient_ncc_large", p.accept_gradient_ncc_large, 0.0, 1.0},
                             {"templates.plain_shape_margin", p.plain_shape_margin, -1.0, 1.0},
                             {"templates.position_jitter_px", p.position_jitter_px, 0.0, 20.0},
                             {"templates.scale_jitter", p.scale_jitter, 0.0, 0.5},
                             {"templates.min_contrast", p.min_contrast, 0.0, 127.0},
                             {"templates.adaptive_block_px", static_cast<double>(p.adaptive_block_px), 3.0, 255.0},
                             {"templates.adaptive_offset", p.adaptive_offset, 0.0, 127.0}}});
}

Status validate_features(const FeatureParams& p) {
  return check_bounds(
      std::array<Bound, 8>{{{"features.max_features", static_cast<double>(p.max_features), 10.0, 20000.0},
                            {"features.contrast_threshold", p.contrast_threshold, 0.001, 0.5},
                            {"features.wanted_features", static_cast<double>(p.wanted_features), 0.0, 20000.0},
                            {"features.ratio", p.ratio, 0.1, 1.0},
                            {"features.reprojection_px", p.reprojection_px, 0.1, 50.0},
                            {"features.min_inliers", static_cast<double>(p.min_inliers), 5.0, 1000.0},
                            {"features.min_inlier_share", p.min_inlier_share, 0.0, 1.0},
                            {"features.max_scale_change", p.max_scale_change, 1.0, 100.0}}});
}

}  // namespace

Status validate(const RecogniserParams& params) {
  if (Status view = validate_view(params.view); !view) {
    return view;
  }
  if (Status templates = validate_templates(params.templates); !templates) {
    return templates;
  }
  return validate_features(params.features);
}

}  // namespace seeker::vision
