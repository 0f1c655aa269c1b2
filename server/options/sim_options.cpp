#include "server/options/sim_options.hpp"

#include "server/options/camera_options.hpp"

namespace seeker::sim {
namespace {

/// One transducer or sensor mount as [x_m, y_m, heading in degrees].
struct Mount {
  Pose2 pose;
};

void describe(config::Fields& f, Mount& mount) { f.field("pose", mount.pose); }

}  // namespace

void describe(config::Fields& f, OdometryModel& model) {
  f.field("sigma_distance", model.sigma_distance);
  f.field("sigma_rotation", model.sigma_rotation);
  f.field("sigma_rotation_per_distance", model.sigma_rotation_per_distance);
  f.field("left_wheel_scale", model.left_wheel_scale);
  f.field("right_wheel_scale", model.right_wheel_scale);
  f.field("wheel_base_scale", model.wheel_base_scale);
}

void describe(config::Fields& f, LidarModel& model) {
  f.field("beams", model.beams);
  f.angle_deg("angle_min_deg", model.angle_min_rad);
  f.angle_deg("angle_step_deg", model.angle_step_rad);
  f.field("range_min_m", model.range_min_m);
  f.field("range_max_m", model.range_max_m);
  f.field("base_T_laser", model.base_T_laser);
  f.field("height_m", model.height_m);
  f.field("sigma_range_m", model.sigma_range_m);
  f.field("sigma_relative", model.sigma_relative);
  f.field("quality_max", model.quality_max);
  f.field("quality_range_m", model.quality_range_m);
  f.angle_deg("sigma_bearing_deg", model.sigma_bearing_rad);
  f.field("quantisation_m", model.quantisation_m);
  f.field("dropout", model.dropout);
  f.angle_deg("grazing_deg", model.grazing_rad);
  f.angle_deg("grazing_certain_deg", model.grazing_certain_rad);
  constexpr int kByte = 255;
  f.check("sigma_relative", model.sigma_relative >= 0.0, "must not be negative");
  f.check("quality_max", model.quality_max >= 0 && model.quality_max <= kByte, "must be from 0 to 255");
  f.check("quality_range_m", model.quality_range_m > 0.0, "must be above 0");
}

void describe(config::Fields& f, SonarModel& model) {
  std::vector<Mount> mounts;
  for (const Pose2& pose : model.base_T_sonar) {
    mounts.push_back({pose});
  }
  f.list("transducers", mounts);
  model.base_T_sonar.clear();
  for (const Mount& mount : mounts) {
    model.base_T_sonar.push_back(mount.pose);
  }
  f.field("height_m", model.height_m);
  f.angle_deg("cone_half_angle_deg", model.cone_half_angle_rad);
  f.field("rays", model.rays);
  f.field("range_min_m", model.range_min_m);
  f.field("range_max_m", model.range_max_m);
  f.field("sigma_m", model.sigma_m);
  f.field("sigma_relative", model.sigma_relative);
  f.angle_deg("specular_deg", model.specular_rad);
  f.field("corner_m", model.corner_m);
  f.field("cross_talk", model.cross_talk);
  f.field("dropout", model.dropout);
}

void describe(config::Fields& f, OmniModel& model) {
  f.field("width_px", model.width_px);
  f.field("height_px", model.height_px);
  f.field("centre_u_px", model.centre_u_px);
  f.field("centre_v_px", model.centre_v_px);
  f.field("rim_px", model.rim_px);
  f.field("shape", model.shape);
  f.field("gain_px", model.gain_px);
  f.field("base_T_camera", model.base_T_camera);
  f.field("height_m", model.height_m);
  f.field("hood_px", model.hood_px);
  f.field("noise_sigma", model.noise_sigma);
  f.field("shot_noise", model.shot_noise);
  f.field("blur_sigma_px", model.blur_sigma_px);
  f.field("vignetting", model.vignetting);
}

void describe(config::Fields& f, TankCameraModel& model) {
  f.field("base_T_camera", model.base_T_camera);
  f.field("height_m", model.height_m);
  f.angle_deg("tilt_deg", model.tilt_rad);
}

void describe(config::Fields& f, EyeErrors& errors) {
  f.field("shift_u_px", errors.shift_u_px);
  f.field("shift_v_px", errors.shift_v_px);
  f.angle_deg("roll_deg", errors.roll_rad);
  f.field("distortion_px", errors.distortion_px);
  f.field("gain", errors.gain);
  f.field("gamma", errors.gamma);
  f.field("vignetting", errors.vignetting);
}

void describe(config::Fields& f, StereoModel& model) {
  f.section("geometry", model.geometry);
  f.field("base_T_left_eye", model.base_T_left_eye);
  f.field("height_m", model.height_m);
  f.field("noise_sigma", model.noise_sigma);
  f.field("shot_noise", model.shot_noise);
  f.field("blur_sigma_px", model.blur_sigma_px);
  f.field("exposure_jitter", model.exposure_jitter);
  f.section("left", model.left);
  f.section("right", model.right);
}

void describe(config::Fields& f, RobotModel& model) {
  f.field("radius_m", model.radius_m);
  f.field("body_height_m", model.body_height_m);
  f.field("deck_height_m", model.deck_height_m);
  f.field("wheel_base_m", model.wheel_base_m);
  f.field("v_max_m_s", model.v_max_m_s);
  f.angle_deg("omega_max_deg_s", model.omega_max_rad_s);
  f.field("acceleration_m_s2", model.acceleration_m_s2);
  f.angle_deg("angular_acceleration_deg_s2", model.angular_acceleration_rad_s2);
  f.field("battery_v", model.battery_v);
  f.field("battery_drain_v_per_h", model.battery_drain_v_per_h);
  f.section("odometry", model.odometry);
  f.section("lidar", model.lidar);
  f.section("sonar", model.sonar);
  f.choice("camera", model.camera,
           config::Choices<CameraKind>{{"omni", CameraKind::kOmni}, {"tank", CameraKind::kTank}});
  f.section("omni", model.omni);
  f.section("tank", model.tank);
  f.section("stereo", model.stereo);
}

}  // namespace seeker::sim
