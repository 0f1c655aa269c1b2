#include "server/options/stereo_options.hpp"

namespace seeker::vision {
namespace {

const config::Choices<Metric> kMetrics{{"l1", Metric::kL1}, {"l2", Metric::kL2}};

}  // namespace

void describe(config::Fields& f, DetectorParams& params) {
  f.choice("descriptor", params.kind,
           config::Choices<DescriptorKind>{{"sift", DescriptorKind::kSift}, {"root_sift", DescriptorKind::kRootSift}});
  f.field("wanted", params.wanted);
  f.field("at_most", params.at_most);
  f.field("contrast_threshold", params.contrast_threshold);
  f.field("contrast_halvings", params.contrast_halvings);
  f.field("edge_threshold", params.edge_threshold);
  f.field("grid_columns", params.grid_columns);
  f.field("grid_rows", params.grid_rows);
  f.field("half_resolution", params.half_resolution);
}

void describe(config::Fields& f, StereoMatchParams& params) {
  f.field("max_row_offset_px", params.max_row_offset_px);
  f.field("min_disparity_px", params.min_disparity_px);
  f.field("max_disparity_px", params.max_disparity_px);
  f.angle_deg("max_rotation_deg", params.max_rotation_rad);
  f.choice("scale_gate_kind", params.scale_gate_kind,
           config::Choices<ScaleGate>{{"difference", ScaleGate::kDifference}, {"ratio", ScaleGate::kRatio}});
  f.field("scale_gate", params.scale_gate);
  f.choice("metric", params.metric, kMetrics);
  f.field("max_distance", params.max_distance);
  f.field("paper_uniqueness", params.paper_uniqueness);
  f.field("max_ratio", params.max_ratio);
  f.field("bbf_leaves", params.bbf_leaves);
  f.field("refine_disparity", params.refine_disparity);
}

void describe(config::Fields& f, StereoFeatureParams& params) {
  f.section("detector", params.detector);
  f.section("match", params.match);
}

}  // namespace seeker::vision

// None of these may stand in an unnamed namespace: argument-dependent look-up would not find them from Fields.
namespace seeker::localize {

static const config::Choices<vision::Metric> kMetrics{{"l1", vision::Metric::kL1}, {"l2", vision::Metric::kL2}};

void describe(config::Fields& f, PixelNoise& params) {
  f.field("sigma_px", params.sigma_px);
  f.field("sigma_disparity_px", params.sigma_disparity_px);
  f.field("separate_eyes", params.separate_eyes);
}

void describe(config::Fields& f, RangeLimits& params) {
  f.field("min_m", params.min_m);
  f.field("max_m", params.max_m);
}

void describe(config::Fields& f, AssociationParams& params) {
  f.choice("metric", params.metric, kMetrics);
  f.field("max_distance", params.max_distance);
  f.field("anywhere", params.anywhere);
  f.field("bbf_leaves", params.bbf_leaves);
  f.field("gate_chi2", params.gate_chi2);
  f.field("max_offset_m", params.max_offset_m);
  f.field("min_offset_m", params.min_offset_m);
}

void describe(config::Fields& f, SparsityParams& params) {
  f.field("on", params.on);
  f.field("inner_radius_m", params.inner_radius_m);
  f.field("outer_radius_m", params.outer_radius_m);
  f.field("min_distance", params.min_distance);
  f.field("best_first", params.best_first);
}

void describe(config::Fields& f, FusionParams& params) {
  f.field("running_mean", params.running_mean);
  f.angle_deg("view_cluster_deg", params.view_cluster_rad);
}

void describe(config::Fields& f, AdjustmentParams& params) {
  f.field("on", params.on);
  f.field("rounds", params.rounds);
  f.field("iterations", params.iterations);
  f.field("huber_sigmas", params.huber_sigmas);
  f.field("point_sigma_m", params.point_sigma_m);
  f.field("offset_sigma_px", params.offset_sigma_px);
}

void describe(config::Fields& f, DatabaseParams& params) {
  f.section("noise", params.noise);
  f.section("range", params.range);
  f.section("association", params.association);
  f.section("sparsity", params.sparsity);
  f.section("fusion", params.fusion);
  f.section("adjustment", params.adjustment);
  f.field("salient_seen", params.salient_seen);
}

void describe(config::Fields& f, LeverArm& arm) {
  f.field("ahead_m", arm.ahead_m);
  f.field("left_m", arm.left_m);
  f.angle_deg("yaw_deg", arm.yaw_rad);
}

void describe(config::Fields& f, MotionNoise& params) {
  f.field("v_share", params.v_share);
  f.field("v_floor_m_s", params.v_floor_m_s);
  f.field("omega_share", params.omega_share);
  f.angle_deg("omega_floor_deg_s", params.omega_floor_rad_s);
  f.angle_deg("drift_deg_per_m", params.drift_per_m);
  f.field("across_share", params.across_share);
  f.field("variance_floor", params.variance_floor);
}

void describe(config::Fields& f, MeasurementNoise& params) {
  f.field("range_floor_m", params.range_floor_m);
  f.angle_deg("bearing_floor_deg", params.bearing_floor_rad);
  f.field("landmark_covariance", params.landmark_covariance);
}

void describe(config::Fields& f, BatchParams& params) {
  f.field("iterations", params.iterations);
  f.field("huber_sigmas", params.huber_sigmas);
}

void describe(config::Fields& f, TrackingParams& params) {
  f.field("max_distance", params.max_distance);
  f.field("max_ratio", params.max_ratio);
  f.field("gate_chi2", params.gate_chi2);
  f.field("window_sigmas", params.window_sigmas);
  f.field("min_window_px", params.min_window_px);
  f.field("height_tolerance_m", params.height_tolerance_m);
  f.angle_deg("max_view_angle_deg", params.max_view_angle_rad);
  f.field("vote_chi2", params.vote_chi2);
  f.field("max_votes", params.max_votes);
}

void describe(config::Fields& f, RelocaliseParams& params) {
  f.field("max_distance", params.max_distance);
  f.field("ambiguity", params.ambiguity);
  f.field("max_scale_ratio", params.max_scale_ratio);
  f.field("attempts", params.attempts);
  f.field("min_separation_m", params.min_separation_m);
  f.field("gate_chi2", params.gate_chi2);
  f.field("height_tolerance_m", params.height_tolerance_m);
  f.field("min_inliers", params.min_inliers);
  f.field("min_likeness", params.min_likeness);
  f.field("many_inliers", params.many_inliers);
  f.field("many_share", params.many_share);
  f.field("min_cells", params.min_cells);
  f.field("cell_columns", params.cell_columns);
  f.field("cell_rows", params.cell_rows);
  f.field("min_lead", params.min_lead);
  f.field("rival_m", params.rival_m);
  f.angle_deg("rival_deg", params.rival_rad);
  f.field("max_sigma_m", params.max_sigma_m);
  f.field("guess_inliers", params.guess_inliers);
  f.field("guess_share", params.guess_share);
  f.field("confirm_m", params.confirm_m);
  f.angle_deg("confirm_deg", params.confirm_rad);
}

void describe(config::Fields& f, ConfidenceParams& params) {
  f.field("min_update_inliers", params.min_update_inliers);
  f.field("min_inliers", params.min_inliers);
  f.field("good_inliers", params.good_inliers);
  f.field("window", params.window);
  f.field("degraded_nis", params.degraded_nis);
  f.field("lost_nis", params.lost_nis);
  f.field("lost_after", params.lost_after);
  f.field("contradicted_after", params.contradicted_after);
  f.field("plenty", params.plenty);
  f.field("lost_sigma_m", params.lost_sigma_m);
  f.angle_deg("lost_sigma_deg", params.lost_sigma_rad);
  f.field("relocalise_after", params.relocalise_after);
}

void describe(config::Fields& f, LocaliserParams& params) {
  f.choice("mode", params.mode,
           config::Choices<FilterMode>{{"joint", FilterMode::kJoint}, {"paper", FilterMode::kPaper}});
  f.choice("metric", params.metric, kMetrics);
  f.field("bbf_leaves", params.bbf_leaves);
  f.section("arm", params.arm);
  f.field("eye_height_m", params.eye_height_m);
  f.section("noise", params.noise);
  f.section("range", params.range);
  f.section("motion", params.motion);
  f.section("measurement", params.measurement);
  f.field("landmark_sigma_floor_m", params.landmark_sigma_floor_m);
  f.field("disparity_offset_sigma_px", params.disparity_offset_sigma_px);
  f.field("disparity_offset_walk_px", params.disparity_offset_walk_px);
  f.field("max_repeats", params.max_repeats);
  f.field("map_sigma_m", params.map_sigma_m);
  f.angle_deg("map_sigma_deg", params.map_sigma_rad);
  f.section("batch", params.batch);
  f.section("tracking", params.tracking);
  f.section("relocalise", params.relocalise);
  f.section("confidence", params.confidence);
}

void describe(config::Fields& f, UpdateParams& params) {
  f.section("database", params.database);
  f.field("count_misses", params.count_misses);
  f.field("max_misses", params.max_misses);
  f.field("seen_there", params.seen_there);
  f.field("seen_gone", params.seen_gone);
  f.field("remove_log_odds", params.remove_log_odds);
  f.field("max_log_odds", params.max_log_odds);
  f.field("occlusion_px", params.occlusion_px);
  f.field("occlusion_ratio", params.occlusion_ratio);
  f.field("min_move_m", params.min_move_m);
  f.angle_deg("min_rotation_deg", params.min_rotation_rad);
  f.field("max_teaching_sigma_m", params.max_teaching_sigma_m);
  f.field("max_removed_share", params.max_removed_share);
}

}  // namespace seeker::localize
