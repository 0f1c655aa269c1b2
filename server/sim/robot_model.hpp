/// \file
/// The simulated robot: a Pioneer 3-DX with a laser scanner, a sonar ring and an omnidirectional camera. The numbers
/// are those of the hardware, with its errors, so that results in simulation are not too good (design.md 8).
#pragma once

#include <cstdint>
#include <numbers>
#include <vector>

#include "common/core/angle.hpp"
#include "common/core/pose2.hpp"
#include "common/core/result.hpp"
#include "common/core/stereo.hpp"

namespace seeker::sim {

/// Errors of the wheel encoders. The random parts grow with the square root of the distance, as a random walk.
struct OdometryModel {
  double sigma_distance = 0.008;               ///< m per sqrt(m) driven, along the path
  double sigma_rotation = 0.006;               ///< rad per sqrt(rad) rotated
  double sigma_rotation_per_distance = 0.005;  ///< heading noise: rad per sqrt(m) driven
  double left_wheel_scale = 1.0006;            ///< measured / true distance of the left wheel
  double right_wheel_scale = 0.9996;           ///< the wheels have different scale errors
  double wheel_base_scale = 1.003;             ///< assumed / true distance between the wheels
};

/// A SICK LMS200 (180 deg, 0.5 deg, 8 m).
struct LidarModel {
  int beams = 361;
  double angle_min_rad = -std::numbers::pi / 2.0;
  double angle_step_rad = std::numbers::pi / 360.0;
  double range_min_m = 0.05;
  double range_max_m = 8.0;
  Pose2 base_T_laser{0.021, 0.0, 0.0};
  double height_m = 0.30;
  double sigma_range_m = 0.010;
  double sigma_relative = 0.0;  ///< part of the noise that grows with the range: sigma^2 = sigma_range^2 + (this r)^2
  /// Signal quality of a wall met at a right angle within quality_range_m; 0: the scanner reports none. It falls with
  /// the cosine of the incidence and with the square of the range, to 1 at least.
  int quality_max = 0;
  double quality_range_m = 1.0;
  double sigma_bearing_rad = 0.0008;
  double quantisation_m = 0.001;
  double dropout = 0.002;                         ///< probability that a beam has no return
  double grazing_rad = deg_to_rad(80.0);          ///< from this angle of incidence on returns get lost ...
  double grazing_certain_rad = deg_to_rad(88.0);  ///< ... and from this one on all of them
};

/// The front ring of a Pioneer 3-DX (protocols.md 1.8).
struct SonarModel {
  std::vector<Pose2> base_T_sonar = {
      {0.069, 0.136, deg_to_rad(90.0)},   {0.114, 0.119, deg_to_rad(50.0)},   {0.148, 0.078, deg_to_rad(30.0)},
      {0.166, 0.027, deg_to_rad(10.0)},   {0.166, -0.027, deg_to_rad(-10.0)}, {0.148, -0.078, deg_to_rad(-30.0)},
      {0.114, -0.119, deg_to_rad(-50.0)}, {0.069, -0.136, deg_to_rad(-90.0)},
  };
  double height_m = 0.20;
  double cone_half_angle_rad = deg_to_rad(15.0);
  int rays = 15;  ///< rays over the cone
  double range_min_m = 0.15;
  double range_max_m = 5.0;
  double sigma_m = 0.005;         ///< constant part
  double sigma_relative = 0.006;  ///< part that grows with the range
  /// Beyond this angle of incidence the echo is reflected away, except at corners.
  double specular_rad = deg_to_rad(25.0);
  double corner_m = 0.04;     ///< an edge or corner within this distance of the hit sends an echo back
  double cross_talk = 0.002;  ///< probability of an echo of another transducer
  double dropout = 0.003;
};

/// Camera below a hyperbolic mirror. Radius in the picture of a ray of elevation e (0 = horizon, up positive):
/// `gain_px cos e / (shape - sin e)`: straight down in the middle, the horizon and what is above it towards the rim.
struct OmniModel {
  int width_px = 640;
  int height_px = 480;
  double centre_u_px = 315.0;  ///< spec S3.5
  double centre_v_px = 240.0;
  double rim_px = 235.0;  ///< outside the mirror the picture is black
  double shape = 1.1;
  double gain_px = 190.0;
  /// Mounted with an error of a degree (spec S3.5) that no estimator is given.
  Pose2 base_T_camera{0.0, 0.0, deg_to_rad(1.0)};
  double height_m = 0.60;    ///< height of the mirror's focus over the floor
  double hood_px = 34.0;     ///< radius of the camera's own reflection
  double noise_sigma = 2.0;  ///< grey values
  double shot_noise = 0.12;  ///< grey values per sqrt(grey value)
  double blur_sigma_px = 0.6;
  double vignetting = 0.22;  ///< loss of light at the rim
};

/// Errors of one eye after calibration and rectification; no estimator is given them (vision.md 4.5).
struct EyeErrors {
  double shift_u_px = 0.0;     ///< the picture lies this far to the right of where it should
  double shift_v_px = 0.0;     ///< the picture lies this far below where it should
  double roll_rad = 0.0;       ///< rotation about the optical axis
  double distortion_px = 0.0;  ///< radial residual in the picture's corner
  double gain = 1.0;           ///< factor of the exposure
  double gamma = 1.0;
  double vignetting = 0.15;  ///< loss of light in the corner
};

/// A forward-looking stereo camera with level optical axes, spec S2.2. The pictures are rectified, up to the residual
/// errors of a calibration.
struct StereoModel {
  StereoGeometry geometry;
  Pose2 base_T_left_eye{0.15, 0.06, 0.0};  ///< spec S2.8: b ahead and a to the left of the rotation centre
  double height_m = 0.90;
  double noise_sigma = 2.0;  ///< grey values
  double shot_noise = 0.05;  ///< grey values per sqrt(grey value)
  double blur_sigma_px = 0.5;
  double exposure_jitter = 0.02;  ///< relative standard deviation from picture to picture, independent for each eye
  EyeErrors left{0.05, -0.05, deg_to_rad(0.004), 0.12, 1.0, 0.95, 0.15};
  EyeErrors right{-0.04, 0.10, deg_to_rad(-0.008), -0.10, 1.06, 1.0, 0.19};
};

/// A camera over the rotation centre that looks down at the floor of a tank, without roll. Its picture is that of
/// server/sim/tank_renderer.
struct TankCameraModel {
  /// Mounted with an error of half a degree that no estimator is given.
  Pose2 base_T_camera{0.0, 0.0, deg_to_rad(0.5)};
  double height_m = 0.80;
  double tilt_rad = deg_to_rad(40.0);  ///< angle down from the horizon
};

/// The camera that the robot has beside the stereo camera.
enum class CameraKind : std::uint8_t { kOmni, kTank };

struct RobotModel {
  double radius_m = 0.26;  ///< spec S3.3
  double body_height_m = 0.65;
  double deck_height_m = 0.28;  ///< height of the robot's top as the camera sees it
  double wheel_base_m = 0.357;
  double v_max_m_s = 0.75;
  double omega_max_rad_s = deg_to_rad(100.0);
  double acceleration_m_s2 = 0.3;
  double angular_acceleration_rad_s2 = deg_to_rad(100.0);
  double battery_v = 12.8;
  double battery_drain_v_per_h = 0.35;
  OdometryModel odometry;
  LidarModel lidar;
  SonarModel sonar;
  CameraKind camera = CameraKind::kOmni;
  OmniModel omni;
  TankCameraModel tank;
  StereoModel stereo;
};

/// Refuses values that cannot be simulated: not finite, not positive, more than kMaxScanBeams beams.
[[nodiscard]] Status validate(const RobotModel& model);

/// The same robot without any errors, for tests of geometry.
[[nodiscard]] RobotModel without_errors(RobotModel model);

}  // namespace seeker::sim
