#include "server/app/composition/loop_options.hpp"

#include <array>
#include <string>
#include <string_view>

#include "common/api/fleet.hpp"
#include "server/options/nav_options.hpp"

namespace seeker::app {

void describe(config::Fields& f, SafetyParams& params) {
  f.field("max_v_m_s", params.max_v_m_s);
  f.angle_deg("max_omega_deg_s", params.max_omega_rad_s);
  f.section("clearance", params.clearance);
  f.field("sonar_stop_range_m", params.sonar_stop_range_m);
  f.field("sonar_slack_m", params.sonar_slack_m);
  f.seconds("lease_request_timeout_s", params.lease.request_timeout);
  f.check("max_v_m_s", params.max_v_m_s > 0.0, "must be above 0");
  f.check("max_omega_deg_s", params.max_omega_rad_s > 0.0, "must be above 0");
  f.check("lease_request_timeout_s", params.lease.request_timeout > Duration::zero(), "must be above 0");
  f.check("sonar_stop_range_m", params.sonar_stop_range_m >= 0.0, "must be 0 or more");
}

namespace {

void describe_source(config::Fields& f, const char* key, bool& fed, std::string_view source) {
  f.choice(key, fed, config::Choices<bool>{{source, true}, {"none", false}});
}

}  // namespace

void describe(config::Fields& f, PoseInputs& inputs) {
  describe_source(f, "scan", inputs.scan, "lidar");
  describe_source(f, "pictures", inputs.pictures, "stereo");
}

void describe(config::Fields& f, MapInputs& inputs) {
  f.choice("ranges", inputs.ranges,
           config::Choices<RangeSensor>{{"lidar", RangeSensor::kLidar}, {"sonar", RangeSensor::kSonar}});
}

void describe(config::Fields& f, RangeInputs& inputs) {
  describe_source(f, "scan", inputs.scan, "lidar");
  describe_source(f, "echoes", inputs.echoes, "sonar");
}

void describe(config::Fields& f, Connections& connections) {
  f.section("pose", connections.pose);
  f.section("map", connections.map);
  f.section("planner", connections.planner);
  f.section("safety", connections.safety);
}

void describe(config::Fields& f, MissionParams& params) {
  f.seconds("link_grace_s", params.link_grace);
  f.seconds("fault_grace_s", params.fault_grace);
  f.seconds("lost_grace_s", params.lost_grace);
  f.angle_deg("look_round_deg_s", params.look_round_rad_s);
  f.check("look_round_deg_s", params.look_round_rad_s >= 0.0, "must not be below 0");
  f.seconds("report_period_s", params.report_period);
}

void describe(config::Fields& f, RobotMapParams& params) {
  f.field("render_scans_per_tick", params.render_scans_per_tick);
  f.check("render_scans_per_tick", params.render_scans_per_tick > 0, "must be above 0");
  f.field("calm_scans_per_tick", params.calm_scans_per_tick);
  f.check("calm_scans_per_tick", params.calm_scans_per_tick > 0, "must be above 0");
  f.field("calm_move_m", params.calm_move_m);
  f.angle_deg("calm_turn_deg", params.calm_rotation_rad);
  f.seconds("segment_period_s", params.segment_period);
  f.seconds("relocalise_limit_s", params.relocalise_limit);
  f.seconds("checkpoint_period_s", params.checkpoint_period);
  f.check("checkpoint_period_s", params.checkpoint_period > Duration::zero(), "must be above 0");
  f.field("checkpoint_distance_m", params.checkpoint_distance_m);
  f.check("checkpoint_distance_m", params.checkpoint_distance_m > 0.0, "must be above 0");
  f.seconds("place_period_s", params.place_period);
  f.check("place_period_s", params.place_period > Duration::zero(), "must be above 0");
  f.seconds("look_round_after_s", params.look_round_after);
  f.angle_deg("look_round_deg_s", params.look_round_rad_s);
  f.check("look_round_deg_s", params.look_round_rad_s >= 0.0, "must not be below 0");
}

void describe(config::Fields& f, FleetMotionParams& params) {
  f.field("robot_radius_m", params.robot_radius_m);
  f.field("slack_m", params.slack_m);
  f.field("slack_m_s", params.slack_m_s);
  f.check("slack_m", params.robot_radius_m > 0.0 && params.slack_m >= 0.0 && params.slack_m_s >= 0.0,
          "must be 0 or more, and the radius above 0");
  f.seconds("max_age_s", params.max_age);
}

void describe(config::Fields& f, NodePictureParams& params) {
  f.choice("at", params.at,
           config::choices_of(std::array{PicturesAt::kNever, PicturesAt::kNodes, PicturesAt::kFrames}));
  f.seconds("frame_period_s", params.frame_period);
  f.check("frame_period_s", params.frame_period > Duration::zero(), "must be above 0");
  f.field("features", params.features);
  f.check("features", params.features >= 1 && params.features <= static_cast<int>(api::kMaxFleetPictureFeatures),
          "must be from 1 to " + std::to_string(api::kMaxFleetPictureFeatures));
}

void describe(config::Fields& f, LoopParams& params) {
  f.seconds("period_s", params.period);
  f.check("period_s", params.period > Duration::zero(), "must be above 0");
  f.seconds("base_timeout_s", params.base_timeout);
  f.seconds("lidar_timeout_s", params.lidar_timeout);
  f.seconds("sonar_timeout_s", params.sonar_timeout);
  f.seconds("tile_period_s", params.tile_period);
  f.seconds("grid_period_s", params.grid_period);
  f.seconds("topology_period_s", params.topology_period);
  f.field("trajectory_spacing_m", params.trajectory_spacing_m);
  f.section("safety", params.safety);
  f.section("mission", params.mission);
  f.section("map", params.map);
  f.section("fleet", params.fleet);
  f.section("pictures", params.pictures);
}

}  // namespace seeker::app
