#include "server/options/fleet_options.hpp"

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
}

}  // namespace seeker::fleet
