#include "server/options/nav_options.hpp"

namespace seeker::nav {

void describe(config::Fields& f, OccupancyParams& params) {
  f.field("max_range_m", params.max_range_m);
  f.field("no_return_clear_m", params.no_return_clear_m);
  f.field("log_odds_hit", params.log_odds_hit);
  f.field("log_odds_miss", params.log_odds_miss);
  f.field("log_odds_min", params.log_odds_min);
  f.field("log_odds_max", params.log_odds_max);
  f.field("sonar_max_range_m", params.sonar_max_range_m);
  f.field("sonar_log_odds_hit", params.sonar_log_odds_hit);
  f.field("sonar_log_odds_miss", params.sonar_log_odds_miss);
  f.field("sonar_log_odds_limit", params.sonar_log_odds_limit);
  f.field("max_tiles", params.max_tiles);
}

void describe(config::Fields& f, CostMapParams& params) {
  f.field("robot_radius_m", params.robot_radius_m);
  f.field("preferred_clearance_m", params.preferred_clearance_m);
  f.field("clearance_weight", params.clearance_weight);
  f.field("occupied_probability", params.occupied_probability);
  f.field("free_probability", params.free_probability);
  f.field("unknown_traversable", params.unknown_traversable);
  f.field("unknown_penalty", params.unknown_penalty);
}

void describe(config::Fields& f, PlannerParams& params) {
  f.field("start_snap_m", params.start_snap_m);
  f.field("goal_snap_m", params.goal_snap_m);
  f.field("shorten", params.shorten);
}

void describe(config::Fields& f, ClearanceParams& params) {
  f.field("radius_m", params.radius_m);
  f.field("slow_margin_m", params.slow_margin_m);
  f.field("decel_m_s2", params.decel_m_s2);
  f.field("reaction_s", params.reaction_s);
  f.field("horizon_m", params.horizon_m);
  f.field("self_radius_m", params.self_radius_m);
}

void describe(config::Fields& f, FollowerParams& params) {
  f.field("max_v_m_s", params.max_v_m_s);
  f.angle_deg("max_omega_deg_s", params.max_omega_rad_s);
  f.field("accel_m_s2", params.accel_m_s2);
  f.angle_deg("alpha_deg_s2", params.alpha_rad_s2);
  f.field("lookahead_m", params.lookahead_m);
  f.angle_deg("rotate_in_place_deg", params.rotate_in_place_rad);
  f.angle_deg("rotate_done_deg", params.rotate_done_rad);
  f.field("heading_gain_1_s", params.heading_gain_1_s);
  f.field("goal_tolerance_m", params.goal_tolerance_m);
  f.angle_deg("heading_tolerance_deg", params.heading_tolerance_rad);
  f.field("min_v_m_s", params.min_v_m_s);
  f.field("blocked_lookahead_m", params.blocked_lookahead_m);
  f.field("blocked_radius_m", params.blocked_radius_m);
  f.field("blocked_for_s", params.blocked_for_s);
  f.field("stuck_for_s", params.stuck_for_s);
  f.field("progress_m", params.progress_m);
  f.angle_deg("progress_deg", params.progress_rad);
  f.field("near_miss_m", params.near_miss_m);
  f.check("near_miss_m", params.near_miss_m >= 0.0, "must be 0 or more");
  f.field("near_miss_v_m_s", params.near_miss_v_m_s);
  f.check("near_miss_v_m_s", params.near_miss_v_m_s > 0.0, "must be above 0");
  f.section("clearance", params.clearance);
}

void describe(config::Fields& f, DriverParams& params) {
  f.field("max_failures", params.max_failures);
  f.field("goal_time_s", params.goal_time_s);
  f.section("follower", params.follower);
}

void describe(config::Fields& f, RetryParams& params) {
  f.field("attempts", params.attempts);
  f.check("attempts", params.attempts >= 1, "must be 1 or more");
  f.field("retry_s", params.retry_s);
  f.check("retry_s", params.retry_s >= 0.0, "must be 0 or more");
}

void describe(config::Fields& f, WaitParams& params) {
  f.field("max_waits", params.max_waits);
  f.field("max_for_nobody", params.max_for_nobody);
}

}  // namespace seeker::nav
