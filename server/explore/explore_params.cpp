#include "server/explore/explore_params.hpp"

#include <cmath>
#include <initializer_list>
#include <string>
#include <utility>

#include "common/core/occupancy_tile.hpp"

namespace seeker::explore {
namespace {

using Fields = std::initializer_list<std::pair<const char*, double>>;

Status all_positive(const Fields& fields) {
  for (const auto& [name, value] : fields) {
    if (!(value > 0.0) || !std::isfinite(value)) {
      return fail(Errc::kInvalidArgument, std::string(name) + " must be above zero");
    }
  }
  return {};
}

Status none_negative(const Fields& fields) {
  for (const auto& [name, value] : fields) {
    if (!(value >= 0.0) || !std::isfinite(value)) {
      return fail(Errc::kInvalidArgument, std::string(name) + " must not be negative");
    }
  }
  return {};
}

Status check_controls(const OneStepParams& p) {
  if (p.v_m_s.empty() || p.omega_rad_s.empty()) {
    return fail(Errc::kInvalidArgument, "one_step: the set of controls must not be empty");
  }
  for (const double v : p.v_m_s) {
    if (!std::isfinite(v) || v < 0.0) {
      return fail(Errc::kInvalidArgument, "one_step.v_m_s: speeds must not be negative");
    }
  }
  for (const double omega : p.omega_rad_s) {
    if (!std::isfinite(omega)) {
      return fail(Errc::kInvalidArgument, "one_step.omega_rad_s: rotation speeds must be finite");
    }
  }
  if (p.trap_decisions < 1 || p.fruitless_decisions < 1 || p.max_observed < 1 || p.sensor.nominal_points < 1) {
    return fail(
        Errc::kInvalidArgument,
        "one_step: trap_decisions, fruitless_decisions, max_observed and sensor.nominal_points must be 1 or more");
  }
  return {};
}

Status check_one_step(const OneStepParams& p) {
  if (const Status controls = check_controls(p); !controls) {
    return controls;
  }
  if (const Status weights = none_negative({{"one_step.settle_s", p.settle_s},
                                            {"one_step.first_look_s", p.first_look_s},
                                            {"one_step.look_round_m", p.look_round_m},
                                            {"one_step.weight_certainty", p.weight_certainty},
                                            {"one_step.weight_extension", p.weight_extension},
                                            {"one_step.weight_ends", p.weight_ends},
                                            {"one_step.corner_gap_m", p.corner_gap_m},
                                            {"one_step.least_growth_m", p.least_growth_m},
                                            {"one_step.least_growth_m2", p.least_growth_m2},
                                            {"one_step.closed_radius_m", p.closed_radius_m},
                                            {"one_step.sensor.grazing_rad", p.sensor.grazing_rad}});
      !weights) {
    return weights;
  }
  return all_positive({{"one_step.observation_period_s", p.observation_period_s},
                       {"one_step.log_floor", p.log_floor},
                       {"one_step.swept_radius_m", p.swept_radius_m},
                       {"one_step.sensor.range_m", p.sensor.range_m},
                       {"one_step.sensor.half_angle_rad", p.sensor.half_angle_rad},
                       {"one_step.sensor.sigma_y_m", p.sensor.sigma_y_m},
                       {"one_step.sensor.sigma_theta_rad", p.sensor.sigma_theta_rad},
                       {"one_step.sensor.sigma_end_m", p.sensor.sigma_end_m},
                       {"one_step.sensor.beam_step_rad", p.sensor.beam_step_rad}});
}

Status check_viewpoints(const ViewpointParams& p) {
  if (p.max_visits < 1 || p.max_failures < 1 || p.max_waits < 0 || p.horizon < 1 || p.beam < 1 ||
      p.max_candidates < 1) {
    return fail(Errc::kInvalidArgument,
                "viewpoints: max_visits, max_failures, horizon, beam and max_candidates must be 1 or more, max_waits 0 "
                "or more");
  }
  if (const Status weights = none_negative({{"viewpoints.min_pocket_m2", p.min_pocket_m2},
                                            {"viewpoints.look_s", p.look_s},
                                            {"viewpoints.retry_s", p.retry_s},
                                            {"viewpoints.failed_radius_m", p.failed_radius_m},
                                            {"viewpoints.gain_lambda_1_m", p.gain_lambda_1_m},
                                            {"viewpoints.min_gain_m2", p.min_gain_m2},
                                            {"viewpoints.weight_floor", p.weight_floor},
                                            {"viewpoints.weight_path", p.weight_path},
                                            {"viewpoints.hysteresis_lg", p.hysteresis_lg}});
      !weights) {
    return weights;
  }
  return all_positive({{"viewpoints.min_frontier_m", p.min_frontier_m},
                       {"viewpoints.max_frontier_m", p.max_frontier_m},
                       {"viewpoints.min_face_m", p.min_face_m},
                       {"viewpoints.min_extension_m", p.min_extension_m},
                       {"viewpoints.max_extension_m", p.max_extension_m},
                       {"viewpoints.view_range_m", p.view_range_m},
                       {"viewpoints.reached_m", p.reached_m},
                       {"viewpoints.same_m", p.same_m},
                       {"viewpoints.min_cut_off_m2", p.min_cut_off_m2},
                       {"viewpoints.replan_period_s", p.replan_period_s}});
}

Status check_tour(const TourParams& p) {
  if (p.max_places < 1 || p.max_places > kMostTourPlaces) {
    return fail(Errc::kInvalidArgument, "tour.max_places must be 1 to " + std::to_string(kMostTourPlaces));
  }
  if (const Status costs = none_negative({{"tour.passage_m", p.passage_m},
                                          {"tour.rotation_m_rad", p.rotation_m_rad},
                                          {"tour.free_rotation_deg", p.free_rotation_rad},
                                          {"tour.aside_rotation_deg", p.aside_rotation_rad},
                                          {"tour.beyond_m", p.beyond_m},
                                          {"tour.expected_wall_m", p.expected_wall_m},
                                          {"tour.detour_m_m2", p.detour_m_m2},
                                          {"tour.room_m2", p.room_m2},
                                          {"tour.passing_m", p.passing_m},
                                          {"tour.passing_wall", p.passing_wall},
                                          {"tour.passing_near_m", p.passing_near_m},
                                          {"tour.hysteresis_m", p.hysteresis_m},
                                          {"tour.look_s", p.look_s},
                                          {"tour.together_m", p.together_m},
                                          {"tour.share_wait_s", p.share_wait_s},
                                          {"tour.idle_wait_s", p.idle_wait_s},
                                          {"tour.rooms.least_room_m2", p.rooms.least_room_m2}});
      !costs) {
    return costs;
  }
  return all_positive({{"tour.first_leg_weight", p.first_leg_weight},
                       {"tour.replan_period_s", p.replan_period_s},
                       {"tour.max_v_m_s", p.max_v_m_s},
                       {"tour.rotate_in_place_deg", p.rotate_in_place_rad},
                       {"tour.rooms.door_half_m", p.rooms.door_half_m}});
}

Status check_guard(const GuardParams& p) {
  if (!(p.regain_position_sigma_m < p.max_position_sigma_m)) {
    return fail(Errc::kInvalidArgument, "guard.regain_position_sigma_m must be below guard.max_position_sigma_m");
  }
  if (const Status reserve =
          none_negative({{"guard.battery_reserve_v", p.battery_reserve_v}, {"guard.home_reserve_s", p.home_reserve_s}});
      !reserve) {
    return reserve;
  }
  return all_positive({{"guard.regain_position_sigma_m", p.regain_position_sigma_m},
                       {"guard.max_position_sigma_m", p.max_position_sigma_m},
                       {"guard.regain_time_s", p.regain_time_s},
                       {"guard.home_m_s", p.home_m_s},
                       {"guard.home_margin", p.home_margin}});
}

}  // namespace

Status validate(const ExploreParams& params) {
  for (const Status& part : {check_one_step(params.one_step), check_viewpoints(params.viewpoints),
                             check_tour(params.tour), check_guard(params.guard)}) {
    if (!part) {
      return part;
    }
  }
  if (params.guard.home_m_s > params.driver.follower.max_v_m_s) {
    return fail(Errc::kInvalidArgument,
                "guard.home_m_s must not be above driver.follower.max_v_m_s: the robot cannot return faster");
  }
  if (!(params.floor_cell_m >= kTileResolution_m)) {
    return fail(Errc::kInvalidArgument, "floor_cell_m must not be below the cells of the occupancy, 0.05 m");
  }
  if (const Status wall =
          none_negative({{"wall.ahead_m", params.wall.ahead_m}, {"wall.new_segment_m", params.wall.new_segment_m}});
      !wall) {
    return wall;
  }
  if (params.driver.max_failures < 0) {
    return fail(Errc::kInvalidArgument, "driver.max_failures must not be negative");
  }
  return all_positive({{"wall.distance_m", params.wall.distance_m},
                       {"wall.switch_m", params.wall.switch_m},
                       {"wall.adjacency_m", params.wall.adjacency_m},
                       {"wall.max_offset_m", params.wall.max_offset_m},
                       {"wall.leave_growth_m", params.wall.leave_growth_m},
                       {"wall.time_limit_s", params.wall.time_limit_s},
                       {"roam.v_m_s", params.roam.v_m_s},
                       {"roam.omega_rad_s", params.roam.omega_rad_s},
                       {"roam.clear_m", params.roam.clear_m},
                       {"cost.robot_radius_m", params.cost.robot_radius_m},
                       {"driver.goal_time_s", params.driver.goal_time_s},
                       {"map_period_s", params.map_period_s},
                       {"segments_period_s", params.segments_period_s}});
}

}  // namespace seeker::explore
