#include "server/options/slam_options.hpp"

namespace seeker::slam {

void describe(config::Fields& f, OdometryParams& params) {
  f.field("along_sigma_m_per_sqrt_m", params.along_sigma_m_per_sqrt_m);
  f.field("across_sigma_m_per_sqrt_m", params.across_sigma_m_per_sqrt_m);
  f.field("theta_sigma_rad_per_sqrt_m", params.theta_sigma_rad_per_sqrt_m);
  f.angle_deg("theta_sigma_rad_per_sqrt_deg", params.theta_sigma_rad_per_sqrt_rad);
  f.field("jump_m", params.jump_m);
  f.field("jump_speed_m_s", params.jump_speed_m_s);
  f.angle_deg("jump_deg", params.jump_rad);
  f.angle_deg("jump_speed_deg_s", params.jump_speed_rad_s);
  f.field("jump_sigma_m", params.jump_sigma_m);
  f.angle_deg("jump_sigma_deg", params.jump_sigma_rad);
}

void describe(config::Fields& f, NormalParams& params) {
  f.field("neighbours", params.neighbours);
  f.field("radius_m", params.radius_m);
  f.field("spacings", params.spacings);
  f.field("noise_sigmas", params.noise_sigmas);
  f.field("max_reach_m", params.max_reach_m);
  f.field("min_points", params.min_points);
  f.field("max_thickness_ratio", params.max_thickness_ratio);
  f.field("noisy_thickness_ratio", params.noisy_thickness_ratio);
}

void describe(config::Fields& f, MatchParams& params) {
  f.field("max_iterations", params.max_iterations);
  f.field("first_gate_m", params.first_gate_m);
  f.field("last_gate_m", params.last_gate_m);
  f.field("gate_shrink", params.gate_shrink);
  f.field("min_normal_cosine", params.min_normal_cosine);
  f.field("huber_m", params.huber_m);
  f.field("inlier_m", params.inlier_m);
  f.field("stop_m", params.stop_m);
  f.angle_deg("stop_deg", params.stop_rad);
  f.field("min_pairs", params.min_pairs);
  f.field("degenerate_ratio", params.degenerate_ratio);
  f.field("sigma_floor_m", params.sigma_floor_m);
  f.field("covariance_inflation", params.covariance_inflation);
  f.field("search_m", params.search_m);
  f.field("kept_share", params.kept_share);
  f.field("weighed_m", params.weighed_m);
  f.angle_deg("search_deg", params.search_rad);
  f.field("search_step_m", params.search_step_m);
  f.angle_deg("search_step_deg", params.search_step_rad);
  f.field("search_points", params.search_points);
  f.field("search_ratio", params.search_ratio);
  f.field("surprise_share", params.surprise_share);
  f.field("max_surprise_share", params.max_surprise_share);
  f.field("search_starts", params.search_starts);
}

void describe(config::Fields& f, LocalCloudParams& params) {
  f.field("keyframe_points", params.keyframe_points);
  f.field("keyframe_distance_m", params.keyframe_distance_m);
  f.angle_deg("keyframe_rotation_deg", params.keyframe_rotation_rad);
  f.field("known_share", params.known_share);
  f.field("new_view_distance_m", params.new_view_distance_m);
  f.angle_deg("new_view_rotation_deg", params.new_view_rotation_rad);
  f.field("local_keyframes", params.local_keyframes);
  f.field("local_range_m", params.local_range_m);
  f.field("rebuild_m", params.rebuild_m);
  f.angle_deg("rebuild_deg", params.rebuild_rad);
  f.field("max_keyframes", params.max_keyframes);
}

void describe(config::Fields& f, ScanMapParams& params) {
  f.section("odometry", params.odometry);
  f.section("normals", params.normals);
  f.section("match", params.match);
  f.section("cloud", params.cloud);
  f.field("match_points", params.match_points);
  f.field("min_move_m", params.min_move_m);
  f.angle_deg("min_rotation_deg", params.min_rotation_rad);
  f.field("good_ratio", params.good_ratio);
  f.field("accept_ratio", params.accept_ratio);
  f.field("gap_m", params.gap_m);
  f.angle_deg("gap_deg", params.gap_rad);
  f.field("new_space_ratio", params.new_space_ratio);
  f.field("lost_after", params.lost_after);
  f.field("max_correction_m", params.max_correction_m);
  f.angle_deg("max_correction_deg", params.max_correction_rad);
  f.field("map_sigma_m", params.map_sigma_m);
  f.angle_deg("map_sigma_deg", params.map_sigma_rad);
}

void describe(config::Fields& f, SpAssociationParams& params) {
  f.choice<SpAssociationMethod>(
      "method", params.method,
      {{"joint", SpAssociationMethod::kJoint}, {"nearest_neighbour", SpAssociationMethod::kNearestNeighbour}});
  f.field("gate", params.gate);
  f.field("nearest_gate", params.nearest_gate);
  f.field("end_gate", params.end_gate);
  f.field("near_gate", params.near_gate);
  f.field("joint_sigmas", params.joint_sigmas);
  f.field("surprise_sigmas", params.surprise_sigmas);
  f.angle_deg("max_angle_deg", params.max_angle_rad);
  f.field("virtual_gap_m", params.virtual_gap_m);
  f.field("real_gap_m", params.real_gap_m);
  f.field("real_gap_sigmas", params.real_gap_sigmas);
  f.field("apart_penalty", params.apart_penalty);
  f.field("max_nodes", params.max_nodes);
}

void describe(config::Fields& f, SpFeatureParams& params) {
  f.field("new_points", params.new_points);
  f.field("new_scans", params.new_scans);
  f.field("tentative_m", params.tentative_m);
  f.angle_deg("tentative_deg", params.tentative_rad);
  f.field("real_scans", params.real_scans);
  f.field("demote_scans", params.demote_scans);
  f.field("min_length_m", params.min_length_m);
  f.field("end_slack_m", params.end_slack_m);
  f.field("merge_gate", params.merge_gate);
  f.angle_deg("merge_angle_deg", params.merge_angle_rad);
  f.field("merge_gap_m", params.merge_gap_m);
  f.field("merge_offset_m", params.merge_offset_m);
  f.field("merge_sigma_m", params.merge_sigma_m);
  f.field("doorway_m", params.doorway_m);
}

void describe(config::Fields& f, SpExistenceParams& params) {
  f.field("misses", params.misses);
  f.field("young_hits", params.young_hits);
  f.field("young_misses", params.young_misses);
  f.field("margin_m", params.margin_m);
  f.angle_deg("grazing_deg", params.grazing_rad);
  f.field("end_margin_m", params.end_margin_m);
  f.field("beams", params.beams);
  f.field("denied", params.denied);
  f.field("min_beams", params.min_beams);
}

void describe(config::Fields& f, SpMapParams& params) {
  f.section("association", params.association);
  f.choice<SpUpdateMethod>("update", params.update,
                           {{"joint", SpUpdateMethod::kJoint}, {"sequential", SpUpdateMethod::kSequential}});
  f.section("features", params.features);
  f.section("existence", params.existence);
  f.field("relinearise_m", params.relinearise_m);
  f.angle_deg("relinearise_deg", params.relinearise_rad);
  f.field("sigma_floor_m", params.sigma_floor_m);
  f.angle_deg("sigma_floor_deg", params.sigma_floor_rad);
  f.field("end_beams", params.end_beams);
  f.field("drift_sigma_m", params.drift_sigma_m);
  f.angle_deg("drift_sigma_deg", params.drift_sigma_rad);
  f.field("robot_sigma_max_m", params.robot_sigma_max_m);
  f.angle_deg("robot_sigma_max_deg", params.robot_sigma_max_rad);
  f.field("degenerate_sigma_m", params.degenerate_sigma_m);
}

void describe(config::Fields& f, PoseGraphParams& params) {
  f.field("stop_m", params.stop_m);
  f.angle_deg("stop_deg", params.stop_rad);
  f.field("first_damping", params.first_damping);
  f.field("max_damping", params.max_damping);
  f.field("graduation", params.graduation);
  f.field("switched_off_weight", params.switched_off_weight);
}

void describe(config::Fields& f, ConsistencyParams& params) {
  f.field("gate_chi2", params.gate_chi2);
  f.field("max_search", params.max_search);
}

void describe(config::Fields& f, PyramidParams& params) {
  f.field("resolution_m", params.resolution_m);
  f.field("sigma_m", params.sigma_m);
  f.field("reach_m", params.reach_m);
  f.field("directions", params.directions);
  f.angle_deg("direction_gate_deg", params.direction_gate_rad);
  f.field("coarse_level", params.coarse_level);
  f.field("max_bytes", params.max_bytes);
}

void describe(config::Fields& f, FreeSpaceParams& params) {
  f.field("resolution_m", params.resolution_m);
  f.field("end_margin_m", params.end_margin_m);
  f.field("max_range_m", params.max_range_m);
  f.field("min_beams", params.min_beams);
  f.field("min_points", params.min_points);
  f.field("solid_ratio", params.solid_ratio);
  f.field("max_cells", params.max_cells);
}

void describe(config::Fields& f, PlaceMapParams& params) {
  f.section("pyramid", params.pyramid);
  f.section("free_space", params.free_space);
  f.field("cloud_cell_m", params.cloud_cell_m);
  f.field("max_cell_m", params.max_cell_m);
}

void describe(config::Fields& f, GlobalSearchParams& params) {
  f.field("max_points", params.max_points);
  f.field("thin_cell_m", params.thin_cell_m);
  f.field("leaf_level", params.leaf_level);
  f.angle_deg("min_step_deg", params.min_step_rad);
  f.angle_deg("max_step_deg", params.max_step_rad);
  f.field("far_quantile", params.far_quantile);
  f.field("min_score", params.min_score);
  f.field("rival_ratio", params.rival_ratio);
  f.field("max_candidates", params.max_candidates);
  f.field("distinct_m", params.distinct_m);
  f.angle_deg("distinct_deg", params.distinct_rad);
  f.field("max_expansions", params.max_expansions);
}

void describe(config::Fields& f, AgreementParams& params) {
  f.field("solid", params.solid);
  f.field("step_m", params.step_m);
  f.field("near_m", params.near_m);
  f.field("end_margin_m", params.end_margin_m);
  f.field("max_range_m", params.max_range_m);
  f.field("max_beams", params.max_beams);
}

void describe(config::Fields& f, JudgeParams& params) {
  f.field("min_fit", params.min_fit);
  f.field("min_standing", params.min_standing);
  f.field("max_through", params.max_through);
  f.field("through_weight", params.through_weight);
  f.field("min_lead", params.min_lead);
  f.field("min_lead_cells", params.min_lead_cells);
  f.field("min_certainty", params.min_certainty);
  f.field("weak_lead", params.weak_lead);
}

void describe(config::Fields& f, KeptPlaceParams& params) {
  f.field("min_fit", params.min_fit);
  f.field("max_disagreement", params.max_disagreement);
  f.field("max_m", params.max_m);
  f.angle_deg("max_deg", params.max_rad);
  f.field("min_lead", params.min_lead);
  f.field("about_m", params.about_m);
  f.field("about_min_fit", params.about_min_fit);
  f.field("about_max_disagreement", params.about_max_disagreement);
  f.field("about_min_lead", params.about_min_lead);
  f.field("sigma_m", params.sigma_m);
  f.angle_deg("sigma_deg", params.sigma_rad);
}

void describe(config::Fields& f, PlaceParams& params) {
  f.section("search", params.search);
  f.section("match", params.match);
  f.section("agreement", params.agreement);
  f.section("judge", params.judge);
  f.section("kept", params.kept);
  f.field("match_points", params.match_points);
}

void describe(config::Fields& f, LoopParams& params) {
  f.section("search", params.search);
  f.section("match", params.match);
  f.section("agreement", params.agreement);
  f.field("window_sigmas", params.window_sigmas);
  f.field("min_window_m", params.min_window_m);
  f.field("max_window_m", params.max_window_m);
  f.field("rival_window_m", params.rival_window_m);
  f.angle_deg("min_window_deg", params.min_window_rad);
  f.angle_deg("max_window_deg", params.max_window_rad);
  f.field("match_points", params.match_points);
  f.field("min_inliers", params.min_inliers);
  f.field("min_overlap", params.min_overlap);
  f.field("min_consistency", params.min_consistency);
  f.field("rival_consistency", params.rival_consistency);
  f.field("sigma_floor_m", params.sigma_floor_m);
  f.angle_deg("sigma_floor_deg", params.sigma_floor_rad);
}

}  // namespace seeker::slam
