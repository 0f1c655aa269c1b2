#include "server/options/line_slam_options.hpp"

#include "server/options/lines_options.hpp"
#include "server/options/slam_options.hpp"

namespace seeker::slam {

void describe(config::Fields& f, PointNetParams& params) {
  f.choice("use", params.use,
           config::Choices<PointUse>{{"off", PointUse::kOff},
                                     {"none", PointUse::kNone},
                                     {"leftover", PointUse::kLeftover},
                                     {"all", PointUse::kAll}});
  f.section("normals", params.normals);
  f.section("match", params.match);
  f.section("cloud", params.cloud);
  f.field("match_points", params.match_points);
  f.field("leftover_m", params.leftover_m);
  f.angle_deg("leftover_deg", params.leftover_rad);
  f.field("first_m", params.first_m);
  f.angle_deg("first_deg", params.first_rad);
  f.field("good_ratio", params.good_ratio);
  f.field("accept_ratio", params.accept_ratio);
  f.field("gap_m", params.gap_m);
  f.angle_deg("gap_deg", params.gap_rad);
  f.field("new_space_ratio", params.new_space_ratio);
  f.field("through_margin_m", params.through.margin_m);
  f.angle_deg("through_grazing_deg", params.through.grazing_rad);
  f.field("denied_ratio", params.denied_ratio);
  f.field("max_correction_m", params.max_correction_m);
  f.angle_deg("max_correction_deg", params.max_correction_rad);
  f.field("sure_ratio", params.sure_ratio);
  f.field("jump_scans", params.jump.scans);
  f.field("jump_agree_m", params.jump.agree_m);
  f.angle_deg("jump_agree_deg", params.jump.agree_rad);
  f.field("far_m", params.far_m);
  f.angle_deg("far_deg", params.far_rad);
  f.field("far_ratio", params.far_ratio);
  f.field("carried_keyframes", params.carried_keyframes);
  f.field("map_sigma_m", params.map_sigma_m);
  f.angle_deg("map_sigma_deg", params.map_sigma_rad);
}

void describe(config::Fields& f, LocalMapParams& params) {
  f.field("max_distance_m", params.max_distance_m);
  f.field("max_segments", params.max_segments);
  f.field("keyframe_distance_m", params.keyframe_distance_m);
  f.angle_deg("keyframe_rotation_deg", params.keyframe_rotation_rad);
  f.field("joint_sigma_m", params.joint_sigma_m);
  f.angle_deg("joint_sigma_deg", params.joint_sigma_rad);
}

void describe(config::Fields& f, LoopPolicy& params) {
  f.section("detector", params.detector);
  f.field("every_m", params.every_m);
  f.field("max_distance_m", params.max_distance_m);
  f.field("max_candidates", params.max_candidates);
  f.field("query_keyframes", params.query_keyframes);
  f.field("view_range_m", params.view_range_m);
  f.field("cached_places", params.cached_places);
  f.field("surprise_chi2", params.surprise_chi2);
  f.field("witnesses", params.witnesses);
  f.field("max_pending", params.max_pending);
  f.field("contradiction", params.contradiction);
  f.field("kernel_width", params.kernel_width);
  f.field("moved_m", params.moved_m);
  f.angle_deg("moved_deg", params.moved_rad);
}

void describe(config::Fields& f, KnownGroundParams& params) {
  f.field("max_keyframes", params.max_keyframes);
  f.field("within_m", params.within_m);
  f.angle_deg("within_deg", params.within_rad);
  f.field("known_share", params.known_share);
  f.field("compared_maps", params.compared_maps);
  f.field("disagreement", params.disagreement);
}

void describe(config::Fields& f, RelocaliseParams& params) {
  f.section("judge", params.place.judge);
  f.field("every_m", params.every_m);
  f.angle_deg("every_deg", params.every_rad);
  f.field("every_scans", params.every_scans);
  f.field("query_keyframes", params.query_keyframes);
  f.field("hint_m", params.hint_m);
  f.angle_deg("hint_deg", params.hint_rad);
  f.field("hint_tries", params.hint_tries);
  f.field("witnesses", params.claim.witnesses);
  f.field("agree_m", params.claim.agree_m);
  f.angle_deg("agree_deg", params.claim.agree_rad);
  f.field("new_view_m", params.claim.moved_m);
  f.angle_deg("new_view_deg", params.claim.moved_rad);
  f.field("max_tries", params.max_tries);
  f.field("joint_sigma_m", params.joint_sigma_m);
  f.angle_deg("joint_sigma_deg", params.joint_sigma_rad);
  f.field("lost_scans", params.lost_scans);
  f.field("contradictions", params.contradictions);
}

void describe(config::Fields& f, FusionParams& params) {
  f.field("max_offset_m", params.max_offset_m);
  f.angle_deg("max_angle_deg", params.max_angle_rad);
  f.field("max_gap_m", params.max_gap_m);
}

void describe(config::Fields& f, OdometryBiasParams& params) {
  f.field("scale_sigma", params.scale_sigma);
  f.angle_deg("drift_sigma_deg_per_m", params.drift_sigma_rad_per_m);
  f.field("rotation_scale_sigma", params.rotation_scale_sigma);
  f.field("skew_sigma", params.skew_sigma);
  f.field("lever_sigma_m", params.lever_sigma_m);
  f.field("drift_share", params.drift_share);
  f.field("match_sigma_m", params.match_sigma_m);
  f.angle_deg("match_sigma_deg", params.match_sigma_rad);
  f.field("gate", params.gate);
}

void describe(config::Fields& f, UnseenMotionParams& params) {
  f.field("still_m", params.still_m);
  f.angle_deg("still_deg", params.still_rad);
  f.field("speed_sigma_mps", params.speed_sigma_mps);
  f.angle_deg("rotation_sigma_degps", params.rotation_sigma_radps);
  f.field("max_speed_mps", params.max_speed_mps);
  f.angle_deg("max_rotation_degps", params.max_rotation_radps);
}

void describe(config::Fields& f, RotationSenseParams& params) {
  f.angle_deg("least_deg", params.least_rad);
  f.angle_deg("most_deg", params.most_rad);
  f.angle_deg("enough_deg", params.enough_rad);
  f.field("reversed_share", params.reversed_share);
}

void describe(config::Fields& f, LineSlamParams& params) {
  f.section("odometry", params.odometry);
  f.section("observation", params.observation);
  f.section("lines", params.lines);
  f.section("points", params.points);
  f.section("local", params.local);
  f.section("loops", params.loops);
  f.section("known_ground", params.known_ground);
  f.section("relocalise", params.relocalise);
  f.section("fusion", params.fusion);
  f.field("observation_period_s", params.observation_period_s);
  f.field("min_move_m", params.min_move_m);
  f.angle_deg("min_rotation_deg", params.min_rotation_rad);
  f.field("still_range_m", params.still_range_m);
  f.field("still_share", params.still_share);
  f.field("silent_share", params.silent_share);
  f.field("stand_scans", params.stand_scans);
  f.field("max_odometry_scale", params.odometry_scale.max);
  f.field("odometry_scale_up", params.odometry_scale.up);
  f.field("odometry_scale_down", params.odometry_scale.down);
  f.section("odometry_bias", params.odometry_bias);
  f.section("unseen", params.unseen);
  f.section("rotation_sense", params.rotation_sense);
  f.field("lost_after", params.lost_after);
  f.field("repeats_fault", params.repeats_fault);
}

}  // namespace seeker::slam
