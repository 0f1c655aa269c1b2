#include "server/options/fleet_options.hpp"

#include <array>

#include "server/options/slam_options.hpp"

namespace seeker::vision {

void describe(config::Fields& f, MatchParams& params) {
  f.field("max_distance", params.max_distance);
  f.field("max_ratio", params.max_ratio);
}

void describe(config::Fields& f, ViewMatchParams& params) {
  f.section("match", params.match);
  f.field("min_matches", params.min_matches);
  f.field("min_share", params.min_share);
  f.field("min_agreement", params.min_agreement);
  f.field("min_agreeing", params.min_agreeing);
  f.angle_deg("max_parallax_deg", params.max_parallax_rad);
}

}  // namespace seeker::vision

namespace seeker::fleet {

void describe(config::Fields& f, SpaceTreeParams& params) {
  f.field("corridor_width_m", params.corridor_width_m);
  f.field("layers", params.layers);
  f.field("max_range_m", params.max_range_m);
  f.field("min_goal_radius_m", params.min_goal_radius_m);
  f.angle_deg("max_goal_span_deg", params.max_goal_span_rad);
}

void describe(config::Fields& f, AuctionParams& params) {
  f.field("lambda_1_m", params.lambda_1_m);
  f.field("near_m", params.near_m);
}

void describe(config::Fields& f, TopologicalParams& params) {
  f.section("tree", params.map.tree);
  f.field("node_distance_m", params.map.node_distance_m);
  f.field("max_edge_m", params.map.max_edge_m);
  f.section("auction", params.auction);
  f.field("max_failures", params.max_failures);
  f.field("retry_s", params.retry_s);
  f.field("replan_period_s", params.replan_period_s);
  f.field("scan_limit_s", params.scan_limit_s);
  f.field("takeover_m", params.takeover_m);
  f.field("patience_s", params.patience_s);
}

void describe(config::Fields& f, IcpParams& params) {
  f.field("first_gate_m", params.first_gate_m);
  f.field("last_gate_m", params.last_gate_m);
  f.field("gate_shrink", params.gate_shrink);
  f.field("keep", params.keep);
  f.field("stop_m2", params.stop_m2);
  f.field("max_iterations", params.max_iterations);
  f.angles_deg("restarts_deg", params.restarts_rad);
  f.field("min_pairs", params.min_pairs);
}

void describe(config::Fields& f, PairCheckParams& params) {
  f.section("search", params.search);
  f.section("match", params.match);
  f.section("agreement", params.agreement);
  f.field("match_points", params.match_points);
  f.field("min_inliers", params.min_inliers);
  f.field("min_overlap", params.min_overlap);
  f.field("min_consistency", params.min_consistency);
  f.field("max_through", params.max_through);
  f.field("min_similarity", params.min_similarity);
  f.field("max_residual_m", params.max_residual_m);
  f.field("similarity_sigma_m", params.similarity_sigma_m);
  f.check("similarity_sigma_m", params.similarity_sigma_m > 0.0, "must be above 0");
  f.section("icp", params.icp);
  f.angles_deg("known_heading_restarts_deg", params.known_heading_restarts_rad);
  f.field("pictured_min_consistency", params.pictured_min_consistency);
  f.field("sigma_floor_m", params.sigma_floor_m);
  f.angle_deg("sigma_floor_deg", params.sigma_floor_rad);
}

void describe(config::Fields& f, OverlapParams& params) {
  f.field("cell_m", params.cell_m);
  f.check("cell_m", params.cell_m > 0.0, "must be above 0");
  f.field("partner_m", params.partner_m);
  f.field("min_normal_cosine", params.min_normal_cosine);
  f.field("piece_gap_m", params.piece_gap_m);
  f.field("witness_wall_m", params.witness_wall_m);
  f.field("settle_m", params.settle_m);
  f.angle_deg("settle_deg", params.settle_rad);
  f.section("match", params.match);
  f.section("agreement", params.agreement);
  f.field("match_points", params.match_points);
}

void describe(config::Fields& f, DistortionParams& params) {
  f.field("sigma_m", params.sigma_m);
  f.angle_deg("sigma_deg", params.sigma_rad);
  f.check("sigma", params.sigma_m > 0.0 && params.sigma_rad > 0.0, "must be above 0");
  f.field("whole_sigma_m", params.whole_sigma_m);
  f.angle_deg("whole_sigma_deg", params.whole_sigma_rad);
}

void describe(config::Fields& f, PictureParams& params) {
  f.section("views", params.views);
  f.field("tries", params.tries);
  f.field("max_checks", params.max_checks);
  f.field("scans_m", params.scans_m);
  f.field("alike_m", params.alike_m);
  f.angle_deg("alike_deg", params.alike_rad);
  f.field("near_m", params.near_m);
  f.field("sure_alike", params.sure_alike);
  f.check("sure_alike", params.sure_alike >= 1, "must be 1 or more");
  f.field("sure_unlike", params.sure_unlike);
  f.check("sure_unlike", params.sure_unlike >= 1, "must be 1 or more");
  f.field("min_features", params.min_features);
  f.field("min_directions", params.min_directions);
}

void describe(config::Fields& f, DeformationParams& params) {
  f.field("min_pairs", params.min_pairs);
  f.field("max_ratio", params.max_ratio);
  f.field("kernel_width", params.kernel_width);
  f.check("kernel_width", params.kernel_width > 0.0, "must be above 0");
  f.field("max_iterations", params.max_iterations);
  f.field("max_sigma_m", params.max_sigma_m);
  f.angle_deg("max_sigma_deg", params.max_sigma_rad);
  f.check("max_sigma", params.max_sigma_m > 0.0 && params.max_sigma_rad > 0.0, "must be above 0");
}

void describe(config::Fields& f, MergeParams& params) {
  f.choice("method", params.method,
           config::choices_of(std::array{MergeMethod::kPicturesAndLaser, MergeMethod::kPrinted}));
  f.section("pair", params.pair);
  f.section("pictures", params.pictures);
  f.field("regions_per_node", params.regions_per_node);
  f.field("max_relations", params.max_relations);
  f.section("consistency", params.consistency);
  f.section("overlap", params.overlap);
  f.section("distortion", params.distortion);
  f.section("deformation", params.deformation);
  f.field("max_hypotheses", params.max_hypotheses);
  f.check("max_hypotheses", params.max_hypotheses >= 1 && params.max_hypotheses <= 16, "must be from 1 to 16");
  f.field("min_pairs", params.min_pairs);
  f.field("min_shared_wall_m", params.min_shared_wall_m);
  f.field("pictured_shared_wall_m", params.pictured_shared_wall_m);
  f.field("sure_shared_wall_m", params.sure_shared_wall_m);
  f.field("min_weak_wall_m", params.min_weak_wall_m);
  f.field("sure_weak_wall_m", params.sure_weak_wall_m);
  f.field("sure_weak_share", params.sure_weak_share);
  f.field("max_contradiction", params.max_contradiction);
  f.field("sure_contradiction", params.sure_contradiction);
  f.field("sure_denied_piece_m", params.sure_denied_piece_m);
  f.field("denied_piece_share", params.denied_piece_share);
  f.field("kept_denied_piece_m", params.kept_denied_piece_m);
  f.check("kept_denied_piece_m", params.kept_denied_piece_m >= params.sure_denied_piece_m,
          "must be sure_denied_piece_m or more");
  f.field("rival_ratio", params.rival_ratio);
  f.field("max_rival_contradiction", params.max_rival_contradiction);
  f.field("max_rival_denied_piece_m", params.max_rival_denied_piece_m);
}

}  // namespace seeker::fleet
