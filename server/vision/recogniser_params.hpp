/// \file
/// Parameters of the recognisers (spec S3.4 [J values]).
#pragma once

#include <optional>

#include "common/core/angle.hpp"
#include "server/vision/omni_camera.hpp"

namespace seeker::vision {

/// Properties of the camera.
struct ViewParams {
  /// With a value: pictures of this omnidirectional camera, searched in its cylindrical panorama. Without: plain
  /// photographs.
  std::optional<OmniCameraParams> omni;
  double photo_fov_rad = deg_to_rad(62.8);  ///< horizontal field of view of plain photographs
  double photo_tilt_rad = 0.0;              ///< tilt of their camera below the horizon
  double photo_height_m = 0.0;              ///< height of their camera above the floor; 0: not known
  double panorama_scale = 1.0;              ///< columns of the panorama per pixel of the horizon circle
  double min_elevation_rad = -0.70;         ///< the panorama's lower edge

  friend bool operator==(const ViewParams&, const ViewParams&) = default;
};

/// Dynamic template matching, spec S3.4.
struct TemplateParams {
  double stretch_low = 0.01;  ///< percentiles of the contrast stretch
  double stretch_high = 0.99;
  double min_area = 0.0005;  ///< smallest area of a region, as a share of the picture
  double max_area = 0.20;
  double aspect_tolerance = 0.25;  ///< relative
  double accept_ncc = 0.70;
  double accept_gradient_ncc = 0.60;  ///< gradient check of candidates of 12 px; 0 switches it off
  /// Gradient check of candidates of 32 px and more, where more of the target is visible; 0 switches it off.
  double accept_gradient_ncc_large = 0.72;
  /// Excess of the NCC with the target over that with any plain shape; -1 switches it off.
  double plain_shape_margin = 0.03;
  double position_jitter_px = 2.0;
  double scale_jitter = 0.10;
  double min_contrast = 6.0;        ///< standard deviation of a candidate, grey levels
  int adaptive_block_px = 41;       ///< side of the local threshold's window, odd
  double adaptive_offset = 6.0;     ///< grey levels from the local mean
  bool extra_binarisations = true;  ///< in addition to Otsu's: Otsu within each class, local mean
  bool inner_anchors = true;        ///< also locate the target by the regions inside its picture
  bool object_alone = true;         ///< also correlate the object of the picture without its ground
  bool refine = true;               ///< refine the box of a promising candidate step by step
  bool only_best = false;           ///< of each target report the best candidate of the picture, as printed

  friend bool operator==(const TemplateParams&, const TemplateParams&) = default;
};

/// Recognition by SIFT features and a homography.
struct FeatureParams {
  int max_features = 1000;  ///< number of key points in the scene
  /// Threshold of SIFT; halved up to twice while fewer than wanted_features are found.
  double contrast_threshold = 0.04;
  int wanted_features = 300;
  double ratio = 0.8;            ///< best to second-best descriptor distance
  double reprojection_px = 3.0;  ///< inlier distance of RANSAC and of the recount
  int min_inliers = 12;
  double min_inlier_share = 0.25;  ///< share of the mutual matches
  double max_scale_change = 8.0;   ///< ratio of the sides between target picture and sighting, in either direction

  friend bool operator==(const FeatureParams&, const FeatureParams&) = default;
};

struct RecogniserParams {
  ViewParams view;
  TemplateParams templates;
  FeatureParams features;

  friend bool operator==(const RecogniserParams&, const RecogniserParams&) = default;
};

/// Fails with kInvalidArgument and the field's name.
[[nodiscard]] Status validate(const RecogniserParams& params);

}  // namespace seeker::vision
