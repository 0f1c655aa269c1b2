#include "server/sim/robot_model.hpp"

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <string>

#include "common/core/image.hpp"
#include "common/core/scan.hpp"

namespace seeker::sim {
namespace {

bool positive(std::initializer_list<double> values) {
  for (const double v : values) {
    if (!std::isfinite(v) || v <= 0.0) {
      return false;
    }
  }
  return true;
}

bool not_negative(std::initializer_list<double> values) {
  for (const double v : values) {
    if (!std::isfinite(v) || v < 0.0) {
      return false;
    }
  }
  return true;
}

bool probability(double p) { return p >= 0.0 && p <= 1.0; }

Status refuse(const char* part, const char* why) {
  return fail(Errc::kInvalidArgument, std::string("robot model: ") + part + " " + why);
}

Status check_base(const RobotModel& m) {
  if (!positive({m.radius_m, m.body_height_m, m.deck_height_m, m.wheel_base_m, m.v_max_m_s, m.omega_max_rad_s,
                 m.acceleration_m_s2, m.angular_acceleration_rad_s2, m.battery_v}) ||
      !not_negative({m.battery_drain_v_per_h})) {
    return refuse("base", "needs sizes and limits above 0");
  }
  const OdometryModel& o = m.odometry;
  if (!not_negative({o.sigma_distance, o.sigma_rotation, o.sigma_rotation_per_distance}) ||
      !positive({o.left_wheel_scale, o.right_wheel_scale, o.wheel_base_scale})) {
    return refuse("odometry", "needs sigmas of 0 or more and scales above 0");
  }
  return {};
}

Status check_lidar(const LidarModel& l) {
  if (l.beams < 1 || static_cast<std::size_t>(l.beams) > kMaxScanBeams) {
    return refuse("lidar", "needs 1 to 8192 beams");
  }
  if (!positive({l.range_max_m, l.grazing_rad, l.grazing_certain_rad}) || l.grazing_certain_rad < l.grazing_rad ||
      !not_negative({l.range_min_m, l.height_m, l.sigma_range_m, l.sigma_bearing_rad, l.quantisation_m}) ||
      !not_negative({l.sigma_relative}) || !positive({l.quality_range_m}) || l.quality_max < 0 ||
      l.quality_max > std::numeric_limits<std::uint8_t>::max() || l.range_min_m >= l.range_max_m ||
      !probability(l.dropout) || !is_finite(l.base_T_laser) || !std::isfinite(l.angle_min_rad) ||
      !std::isfinite(l.angle_step_rad) || l.angle_step_rad == 0.0) {
    return refuse("lidar", "has a value outside its range");
  }
  return {};
}

Status check_sonar(const SonarModel& s) {
  constexpr std::size_t kMaxSonars = 64;
  constexpr int kMaxRays = 1000;
  if (s.base_T_sonar.size() > kMaxSonars || s.rays < 1 || s.rays > kMaxRays) {
    return refuse("sonar", "allows up to 64 transducers of 1 to 1000 rays");
  }
  bool finite = true;
  for (const Pose2& pose : s.base_T_sonar) {
    finite = finite && is_finite(pose);
  }
  if (!finite || !positive({s.range_max_m}) ||
      !not_negative({s.height_m, s.cone_half_angle_rad, s.range_min_m, s.sigma_m, s.sigma_relative, s.specular_rad,
                     s.corner_m}) ||
      s.range_min_m >= s.range_max_m || !probability(s.cross_talk) || !probability(s.dropout)) {
    return refuse("sonar", "has a value outside its range");
  }
  return {};
}

Status check_omni(const OmniModel& o) {
  if (o.width_px < 1 || o.height_px < 1 || o.width_px > kMaxImageSide_px || o.height_px > kMaxImageSide_px) {
    return refuse("omni camera", "needs a picture of 1 to 8192 pixels on a side");
  }
  if (!positive({o.rim_px, o.gain_px, o.height_m}) || !(o.shape > 1.0) || !std::isfinite(o.shape) ||
      !not_negative({o.hood_px, o.noise_sigma, o.shot_noise, o.blur_sigma_px, o.vignetting}) || o.vignetting > 1.0 ||
      !std::isfinite(o.centre_u_px) || !std::isfinite(o.centre_v_px) || !is_finite(o.base_T_camera)) {
    return refuse("omni camera", "has a value outside its range (shape must be above 1)");
  }
  // The mirror must have a ray for each of its pixels (see OmniModel).
  if (o.rim_px * o.shape > std::hypot(o.rim_px, o.gain_px)) {
    return refuse("omni camera", "has a rim_px that its shape and gain_px cannot reach");
  }
  return {};
}

Status check_tank(const TankCameraModel& t) {
  if (!is_finite(t.base_T_camera) || !positive({t.height_m}) || !(std::abs(t.tilt_rad) < deg_to_rad(90.0))) {
    return refuse("tank camera", "has a value outside its range");
  }
  return {};
}

bool valid_eye(const EyeErrors& e) {
  constexpr double kLargestShift_px = 100.0;
  for (const double v : {e.shift_u_px, e.shift_v_px, e.distortion_px}) {
    if (!(std::abs(v) <= kLargestShift_px)) {
      return false;
    }
  }
  return positive({e.gain, e.gamma}) && not_negative({e.vignetting}) && e.vignetting <= 1.0 &&
         std::abs(e.roll_rad) <= deg_to_rad(10.0);
}

Status check_stereo(const StereoModel& s) {
  if (const Status valid = seeker::validate(s.geometry); !valid) {
    return fail_with_context("robot model: stereo camera", valid.error());
  }
  if (!is_finite(s.base_T_left_eye) || !positive({s.height_m}) ||
      !not_negative({s.noise_sigma, s.shot_noise, s.blur_sigma_px, s.exposure_jitter}) || !valid_eye(s.left) ||
      !valid_eye(s.right)) {
    return refuse("stereo camera", "has a value outside its range");
  }
  return {};
}

}  // namespace

Status validate(const RobotModel& model) {
  if (const Status base = check_base(model); !base) {
    return base;
  }
  if (const Status lidar = check_lidar(model.lidar); !lidar) {
    return lidar;
  }
  if (const Status sonar = check_sonar(model.sonar); !sonar) {
    return sonar;
  }
  if (const Status omni = check_omni(model.omni); !omni) {
    return omni;
  }
  if (const Status tank = check_tank(model.tank); !tank) {
    return tank;
  }
  return check_stereo(model.stereo);
}

RobotModel without_errors(RobotModel model) {
  model.odometry = {0.0, 0.0, 0.0, 1.0, 1.0, 1.0};
  LidarModel& lidar = model.lidar;
  lidar.sigma_range_m = lidar.sigma_relative = lidar.sigma_bearing_rad = lidar.quantisation_m = lidar.dropout = 0.0;
  lidar.grazing_rad = lidar.grazing_certain_rad = kPi / 2.0;
  SonarModel& sonar = model.sonar;
  sonar.sigma_m = sonar.sigma_relative = sonar.cross_talk = sonar.dropout = 0.0;
  OmniModel& omni = model.omni;
  omni.base_T_camera.theta_rad = 0.0;
  omni.noise_sigma = omni.shot_noise = omni.blur_sigma_px = omni.vignetting = 0.0;
  model.tank.base_T_camera.theta_rad = 0.0;
  StereoModel& stereo = model.stereo;
  stereo.noise_sigma = stereo.shot_noise = stereo.blur_sigma_px = stereo.exposure_jitter = 0.0;
  stereo.left = stereo.right = EyeErrors{0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0};
  return model;
}

}  // namespace seeker::sim
