#include "server/sim/robot_in_world.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/angle.hpp"
#include "server/sim/range_sensors.hpp"
#include "server/sim/tank_renderer.hpp"

namespace seeker::sim {
namespace {

constexpr double kSecondsPerHour = 3600.0;
/// What the housing of a robot looks like to others.
constexpr Surface kHousing{0.22, 0.15, 0.10, 9001};

/// Farther away the water is all that a camera sees.
constexpr double kTankSight_m = 10.0;

/// A solid as high as the eye hides what is behind it like a wall; lower solids are drawn as solids.
TankWalls walls_around(const Scene& scene, const Pose2& world_T_camera, double height_m) {
  constexpr int kDirections = 361;
  TankWalls walls{-kPi / 2.0, kPi / (kDirections - 1), {}};
  walls.distance_m.reserve(kDirections);
  for (int i = 0; i < kDirections; ++i) {
    const double angle = world_T_camera.theta_rad + walls.first_rad + i * walls.step_rad;
    const Point2 direction(std::cos(angle), std::sin(angle));
    const auto hit = scene.nearest(world_T_camera.translation(), direction, kTankSight_m, height_m);
    walls.distance_m.push_back(hit ? std::max(hit->distance_m, 1e-3) : kTankSight_m);
  }
  return walls;
}

}  // namespace

RobotInWorld::RobotInWorld(const World& world, RobotModel model, std::uint64_t seed, const Pose2& start,
                           std::size_t serial)
    : world_(world),
      model_(std::move(model)),
      scene_(world),
      body_(start),
      world_T_start_(start),
      paint_(make_paint(kHousing, serial)),
      root_(seed),
      odometry_rng_(root_.fork("odometry")),
      lidar_rng_(root_.fork("lidar")),
      sonar_rng_(root_.fork("sonar")),
      camera_rng_(root_.fork("omni")),
      tank_rng_(root_.fork("tank")),
      stereo_rng_(root_.fork("stereo")) {}

void RobotInWorld::step(Duration period) {
  const double dt_s = to_seconds(period);
  const Twist2 happened = body_.step(wanted_, model_, scene_, dt_s);
  encoders_.step(happened, dt_s, model_, odometry_rng_);
}

Disc RobotInWorld::disc() const {
  return {body_.world_T_base().translation(), model_.radius_m, model_.body_height_m, paint_};
}

/// Of one picture: the lamps swing, and the camera does not set itself the same twice.
double RobotInWorld::exposure(RobotTime now, Rng& rng) const {
  const Lighting& light = world_.lighting;
  const double swing = std::sin(kTwoPi * to_seconds(now) / light.flicker_period_s);
  return std::max(0.0, 1.0 + light.flicker * swing + rng.normal(light.exposure_jitter));
}

BaseReading RobotInWorld::odometry(RobotTime now) const {
  const double hours = to_seconds(now) / kSecondsPerHour;
  return {encoders_.odom_T_base(), encoders_.velocity(), model_.battery_v - hours * model_.battery_drain_v_per_h,
          body_.blocked(), body_.touching()};
}

LaserScan RobotInWorld::scan(RobotTime now) {
  return sweep(model_.lidar, scene_, body_.world_T_base(), now, lidar_rng_);
}

SonarScan RobotInWorld::sonar(RobotTime now) {
  return ping(model_.sonar, scene_, body_.world_T_base(), now, sonar_rng_);
}

Image RobotInWorld::omni_image(RobotTime now) {
  if (!omni_) {
    omni_ = std::make_unique<OmniRenderer>(model_);
  }
  const double brightness = exposure(now, camera_rng_);
  return omni_->render(scene_, world_.lighting, body_.world_T_base(), brightness, camera_rng_);
}

Image RobotInWorld::tank_image() {
  const Pose2 world_T_camera = body_.world_T_base() * model_.tank.base_T_camera;
  TankEye eye;
  eye.position = {world_T_camera.x_m, world_T_camera.y_m, model_.tank.height_m};
  eye.heading_rad = world_T_camera.theta_rad;
  eye.tilt_rad = model_.tank.tilt_rad;
  const TankWalls walls = walls_around(scene_, world_T_camera, model_.tank.height_m);
  return render_tank(world_.solids, eye, walls, world_.water, tank_rng_);
}

StereoFrame RobotInWorld::stereo_pair(RobotTime now) {
  if (!stereo_) {
    stereo_ = std::make_unique<StereoRenderer>(model_.stereo);
  }
  const double brightness = exposure(now, stereo_rng_);
  StereoFrame frame = stereo_->render(scene_, world_.lighting, body_.world_T_base(), brightness, stereo_rng_);
  frame.stamp = now;
  return frame;
}

GroundTruth RobotInWorld::truth() const {
  GroundTruth truth{body_.world_T_base(),
                    world_T_start_,
                    body_.velocity(),
                    body_.contacts(),
                    body_.path_length_m(),
                    body_.min_clearance_m(),
                    {}};
  for (const Target& target : world_.targets) {
    truth.targets.push_back({target.name, target.world_T_target});
  }
  return truth;
}

}  // namespace seeker::sim
