#include "server/options/search_options.hpp"

namespace seeker::search {

void describe(config::Fields& f, ControlTableParams& params) {
  f.field("distances_m", params.distances_m);
  f.field("target_step_deg", params.target_step_deg);
}

void describe(config::Fields& f, PaperParams& params) {
  f.field("cell_m", params.cell_m);
  f.field("sonar_limit_m", params.sonar_limit_m);
  f.field("robot_radius_m", params.robot_radius_m);
  f.field("passes_limit", params.passes_limit);
  f.field("area_m2", params.area_m2);
  f.field("reach_time_s", params.reach_time_s);
  f.field("progress_time_s", params.progress_time_s);
  f.field("progress_m", params.progress_m);
  f.field("stuck_time_s", params.stuck_time_s);
  f.field("stuck_move_m", params.stuck_move_m);
  f.field("recovery_back_m", params.recovery_back_m);
  f.field("recovery_rotation_s", params.recovery_rotation_s);
  f.angle_deg("recovery_omega_deg_s", params.recovery_omega_rad_s);
  f.field("recovery_clear_m", params.recovery_clear_m);
  f.field("max_recoveries", params.max_recoveries);
  f.field("sonar_silence_s", params.sonar_silence_s);
  f.section("drive", params.drive);
}

void describe(config::Fields& f, DriveLawParams& params) {
  f.field("max_v_m_s", params.max_v_m_s);
  f.angle_deg("max_omega_deg_s", params.max_omega_rad_s);
  f.field("rotation_time_s", params.rotation_time_s);
  f.field("stop_distance_m", params.stop_distance_m);
  f.field("slow_span_m", params.slow_span_m);
}

void describe(config::Fields& f, PlanParams& params) {
  f.field("cell_m", params.cell_m);
  f.field("replan_period_s", params.replan_period_s);
  f.field("map_period_s", params.map_period_s);
  f.field("look_spacing_m", params.look_spacing_m);
  f.field("stop_spacing_m", params.stop_spacing_m);
  f.field("look_while_moving", params.look_while_moving);
  f.field("cell_target_probability", params.cell_target_probability);
  f.field("min_gain_cells", params.min_gain_cells);
  f.field("frontier_bonus_cells", params.frontier_bonus_cells);
  f.field("travel_offset_m", params.travel_offset_m);
  f.field("min_frontier_m", params.min_frontier_m);
  f.field("frontier_reach_m", params.frontier_reach_m);
  f.field("max_failures", params.max_failures);
  f.field("goal_time_s", params.goal_time_s);
  f.field("failed_radius_m", params.failed_radius_m);
  f.field("retry_s", params.retry_s);
  f.field("min_cut_off_m2", params.min_cut_off_m2);
  f.section("waits", params.waits);
  f.field("min_look_spacing_m", params.min_look_spacing_m);
  f.section("cost", params.cost);
  f.section("follower", params.follower);
}

void describe(config::Fields& f, MissionParams& params) {
  f.field("image_timeout_s", params.image_timeout_s);
  f.field("settle_s", params.settle_s);
  f.field("standoff_m", params.standoff_m);
  f.field("standoff_tolerance_m", params.standoff_tolerance_m);
  f.angle_deg("face_tolerance_deg", params.face_tolerance_rad);
  f.field("approach_time_s", params.approach_time_s);
  f.field("confirm_time_s", params.confirm_time_s);
  f.field("confirm_step_m", params.confirm_step_m);
  f.field("confirm_looks", params.confirm_looks);
  f.field("doubtful_looks", params.doubtful_looks);
  f.field("max_position_sigma_m", params.max_position_sigma_m);
}

void describe(config::Fields& f, EvidenceParams& params) {
  f.field("cell_m", params.cell_m);
  f.field("threshold", params.threshold);
  f.field("independent_after_m", params.independent_after_m);
  f.field("max_probability", params.max_probability);
  f.field("min_gap_m2", params.min_gap_m2);
}

void describe(config::Fields& f, HitRate& params) {
  f.field("best", params.best);
  f.field("half_size_px", params.half_size_px);
  f.field("size_slope_px", params.size_slope_px);
  f.field("min_range_m", params.min_range_m);
  f.field("max_range_m", params.max_range_m);
  f.field("pixels_per_rad", params.pixels_per_rad);
  f.field("mean_view_foreshortening", params.mean_view_foreshortening);
}

void describe(config::Fields& f, DetectionParams& params) {
  f.field("base_T_camera", params.base_T_camera);
  f.angle_deg("bearing_sigma_deg", params.bearing_sigma_rad);
  f.field("sonar_sigma_m", params.sonar_sigma_m);
  f.field("lidar_sigma_m", params.lidar_sigma_m);
  f.field("floor_sigma_m", params.floor_sigma_m);
  f.field("sonar_max_range_m", params.sonar_max_range_m);
  f.field("sonar_radius_m", params.sonar_radius_m);
  f.check("sonar_radius_m", params.sonar_radius_m >= 0.0, "must be 0 or more");
  f.field("lidar_max_range_m", params.lidar_max_range_m);
  f.angle_deg("lidar_window_deg", params.lidar_window_rad);
  f.field("size_range_factor", params.size_range_factor);
  f.field("depth_sigma_m", params.depth_sigma_m);
  f.angle_deg("min_parallax_deg", params.min_parallax_rad);
  f.field("gate_position", params.gate_position);
  f.field("gate_bearing", params.gate_bearing);
  f.field("new_place_m", params.new_place_m);
  f.field("confirm_places", params.confirm_places);
  f.field("confirm_position", params.confirm_position);
  f.field("sure_score", params.sure_score);
  f.field("max_misses", params.max_misses);
  f.field("miss_probability", params.miss_probability);
  f.field("doubtful_score", params.doubtful_score);
  f.field("doubtful_unseen", params.doubtful_unseen);
  f.field("max_bearing_range_m", params.max_bearing_range_m);
}

void describe(config::Fields& f, SearchParams& params) {
  f.section("paper", params.paper);
  f.section("plan", params.plan);
  f.section("mission", params.mission);
  f.section("evidence", params.evidence);
  f.section("hit_rate", params.hit_rate);
  f.section("detection", params.detection);
}

}  // namespace seeker::search
