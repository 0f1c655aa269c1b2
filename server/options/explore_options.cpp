#include "server/options/explore_options.hpp"

namespace seeker::tour {

void describe(config::Fields& f, RoomsParams& params) {
  f.field("door_half_m", params.door_half_m);
  f.field("least_room_m2", params.least_room_m2);
}

}  // namespace seeker::tour

namespace seeker::explore {

void describe(config::Fields& f, SensorModel& params) {
  f.field("range_m", params.range_m);
  f.angle_deg("half_angle_deg", params.half_angle_rad);
  f.angle_deg("grazing_deg", params.grazing_rad);
  f.field("sigma_y_m", params.sigma_y_m);
  f.angle_deg("sigma_theta_deg", params.sigma_theta_rad);
  f.field("sigma_end_m", params.sigma_end_m);
  f.field("nominal_points", params.nominal_points);
  f.angle_deg("beam_step_deg", params.beam_step_rad);
}

void describe(config::Fields& f, OneStepParams& params) {
  f.field("v_m_s", params.v_m_s);
  f.angles_deg("omega_deg_s", params.omega_rad_s);
  f.field("observation_period_s", params.observation_period_s);
  f.field("stop_and_go", params.stop_and_go);
  f.field("settle_s", params.settle_s);
  f.field("first_look_s", params.first_look_s);
  f.field("look_round_m", params.look_round_m);
  f.field("weight_certainty", params.weight_certainty);
  f.field("weight_extension", params.weight_extension);
  f.field("weight_ends", params.weight_ends);
  f.field("log_floor", params.log_floor);
  f.field("swept_radius_m", params.swept_radius_m);
  f.field("corner_gap_m", params.corner_gap_m);
  f.field("trap_decisions", params.trap_decisions);
  f.field("fruitless_decisions", params.fruitless_decisions);
  f.field("least_growth_m", params.least_growth_m);
  f.field("least_growth_m2", params.least_growth_m2);
  f.field("closed_radius_m", params.closed_radius_m);
  f.field("max_observed", params.max_observed);
  f.field("escape_by_path", params.escape_by_path);
  f.field("use_floor", params.use_floor);
  f.field("all_segments", params.all_segments);
  f.section("sensor", params.sensor);
  f.section("odometry", params.odometry);
}

void describe(config::Fields& f, WallParams& params) {
  f.field("distance_m", params.distance_m);
  f.field("switch_m", params.switch_m);
  f.field("adjacency_m", params.adjacency_m);
  f.field("max_offset_m", params.max_offset_m);
  f.field("ahead_m", params.ahead_m);
  f.field("leave_growth_m", params.leave_growth_m);
  f.field("new_segment_m", params.new_segment_m);
  f.field("growth_per_step", params.growth_per_step);
  f.field("whole_lap", params.whole_lap);
  f.field("time_limit_s", params.time_limit_s);
}

void describe(config::Fields& f, RoamParams& params) {
  f.field("v_m_s", params.v_m_s);
  f.angle_deg("omega_deg_s", params.omega_rad_s);
  f.field("clear_m", params.clear_m);
}

void describe(config::Fields& f, ViewpointParams& params) {
  f.field("min_frontier_m", params.min_frontier_m);
  f.field("max_frontier_m", params.max_frontier_m);
  f.field("min_pocket_m2", params.min_pocket_m2);
  f.field("min_face_m", params.min_face_m);
  f.field("min_extension_m", params.min_extension_m);
  f.field("max_extension_m", params.max_extension_m);
  f.field("view_range_m", params.view_range_m);
  f.field("reached_m", params.reached_m);
  f.field("same_m", params.same_m);
  f.field("max_visits", params.max_visits);
  f.field("look_s", params.look_s);
  f.field("max_failures", params.max_failures);
  f.field("retry_s", params.retry_s);
  f.field("max_waits", params.max_waits);
  f.field("failed_radius_m", params.failed_radius_m);
  f.field("min_cut_off_m2", params.min_cut_off_m2);
  f.field("replan_period_s", params.replan_period_s);
  f.field("gain_lambda_1_m", params.gain_lambda_1_m);
  f.field("min_gain_m2", params.min_gain_m2);
  f.field("horizon", params.horizon);
  f.field("beam", params.beam);
  f.field("hysteresis_lg", params.hysteresis_lg);
  f.field("max_candidates", params.max_candidates);
  f.field("weight_floor", params.weight_floor);
  f.field("weight_path", params.weight_path);
}

void describe(config::Fields& f, TourParams& params) {
  f.field("passage_m", params.passage_m);
  f.field("rotation_m_rad", params.rotation_m_rad);
  f.angle_deg("free_rotation_deg", params.free_rotation_rad);
  f.angle_deg("aside_rotation_deg", params.aside_rotation_rad);
  f.field("first_leg_weight", params.first_leg_weight);
  f.field("beyond_m", params.beyond_m);
  f.field("expected_wall_m", params.expected_wall_m);
  f.field("detour_m_m2", params.detour_m_m2);
  f.field("room_m2", params.room_m2);
  f.field("passing_m", params.passing_m);
  f.field("passing_wall", params.passing_wall);
  f.field("passing_near_m", params.passing_near_m);
  f.field("hysteresis_m", params.hysteresis_m);
  f.field("replan_period_s", params.replan_period_s);
  f.field("max_v_m_s", params.max_v_m_s);
  f.angle_deg("rotate_in_place_deg", params.rotate_in_place_rad);
  f.field("look_s", params.look_s);
  f.field("max_places", params.max_places);
  f.field("share_wait_s", params.share_wait_s);
  f.field("idle_wait_s", params.idle_wait_s);
  f.field("together_m", params.together_m);
  f.section("rooms", params.rooms);
}

void describe(config::Fields& f, GuardParams& params) {
  f.field("max_position_sigma_m", params.max_position_sigma_m);
  f.field("regain_position_sigma_m", params.regain_position_sigma_m);
  f.field("regain_time_s", params.regain_time_s);
  f.field("battery_reserve_v", params.battery_reserve_v);
  f.field("home_m_s", params.home_m_s);
  f.field("home_margin", params.home_margin);
  f.field("home_reserve_s", params.home_reserve_s);
}

void describe(config::Fields& f, ExploreParams& params) {
  f.section("one_step", params.one_step);
  f.section("wall", params.wall);
  f.section("roam", params.roam);
  f.section("viewpoints", params.viewpoints);
  f.section("tour", params.tour);
  f.section("guard", params.guard);
  f.section("cost", params.cost);
  f.section("driver", params.driver);
  f.field("floor_cell_m", params.floor_cell_m);
  f.field("map_period_s", params.map_period_s);
  f.field("segments_period_s", params.segments_period_s);
}

}  // namespace seeker::explore
