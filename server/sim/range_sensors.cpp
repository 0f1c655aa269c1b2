#include "server/sim/range_sensors.hpp"

#include <algorithm>
#include <cmath>

namespace seeker::sim {
namespace {

/// Probability that a return is lost on a surface seen under this incidence.
double grazing_loss(const LidarModel& model, double cos_incidence) {
  if (cos_incidence >= std::cos(model.grazing_rad)) {
    return 0.0;
  }
  const double incidence = std::acos(cos_incidence);
  const double span = model.grazing_certain_rad - model.grazing_rad;
  return span > 0.0 ? std::min(1.0, (incidence - model.grazing_rad) / span) : 1.0;
}

float laser_range(const LidarModel& model, const std::optional<RayHit>& hit, Rng& rng) {
  // The same number of draws for each beam keeps beams comparable between worlds.
  const double luck = rng.uniform();
  const double sigma_m =
      hit ? std::hypot(model.sigma_range_m, model.sigma_relative * hit->distance_m) : model.sigma_range_m;
  const double noise_m = rng.normal(sigma_m);
  if (!hit || luck < model.dropout + grazing_loss(model, hit->cos_incidence)) {
    return kNoReturn;
  }
  double range_m = hit->distance_m + noise_m;
  if (model.quantisation_m > 0.0) {
    range_m = std::round(range_m / model.quantisation_m) * model.quantisation_m;
  }
  return range_m > model.range_max_m ? kNoReturn : static_cast<float>(std::max(range_m, model.range_min_m));
}

/// The received power of a diffuse surface, in the scanner's own units. A beam without return is a measurement, too.
std::uint8_t laser_quality(const LidarModel& model, const std::optional<RayHit>& hit, float range_m) {
  if (!hit || !std::isfinite(range_m)) {
    return 1;
  }
  const double share = model.quality_range_m / std::max(hit->distance_m, model.quality_range_m);
  const double quality = std::round(model.quality_max * hit->cos_incidence * share * share);
  return static_cast<std::uint8_t>(std::clamp(quality, 1.0, static_cast<double>(model.quality_max)));
}

/// Nearest echo in the cone of a transducer at `world_T_sonar`; nothing when all goes elsewhere.
std::optional<double> nearest_echo_m(const SonarModel& model, const Scene& scene, const Pose2& world_T_sonar) {
  const double cos_specular = std::cos(model.specular_rad);
  std::optional<double> nearest_m;
  for (int i = 0; i < model.rays; ++i) {
    const double share = model.rays > 1 ? 2.0 * i / (model.rays - 1) - 1.0 : 0.0;
    const double angle = world_T_sonar.theta_rad + share * model.cone_half_angle_rad;
    const Point2 direction(std::cos(angle), std::sin(angle));
    const auto hit = scene.nearest(world_T_sonar.translation(), direction, model.range_max_m, model.height_m);
    if (hit && (hit->cos_incidence >= cos_specular || hit->to_edge_m <= model.corner_m)) {
      nearest_m = std::min(nearest_m.value_or(hit->distance_m), hit->distance_m);
    }
  }
  return nearest_m;
}

float sonar_range(const SonarModel& model, const std::optional<double>& echo_m, Rng& rng) {
  const double luck = rng.uniform();
  const double stray_m = rng.uniform(model.range_min_m, model.range_max_m);
  const double unit = rng.normal(1.0);
  if (luck < model.cross_talk) {
    return static_cast<float>(std::min(stray_m, echo_m.value_or(stray_m)));
  }
  if (!echo_m || luck < model.cross_talk + model.dropout) {
    return kNoReturn;
  }
  const double range_m = *echo_m + unit * (model.sigma_m + model.sigma_relative * *echo_m);
  return range_m > model.range_max_m ? kNoReturn : static_cast<float>(std::max(range_m, model.range_min_m));
}

}  // namespace

LaserScan sweep(const LidarModel& model, const Scene& scene, const Pose2& world_T_base, RobotTime stamp, Rng& rng) {
  LaserScan scan;
  scan.stamp = stamp;
  scan.angle_min_rad = model.angle_min_rad;
  scan.angle_step_rad = model.angle_step_rad;
  scan.range_min_m = model.range_min_m;
  scan.range_max_m = model.range_max_m;
  scan.base_T_laser = model.base_T_laser;
  scan.ranges_m.reserve(static_cast<std::size_t>(model.beams));
  const Pose2 world_T_laser = world_T_base * model.base_T_laser;
  // Walls a little beyond the range may come into it by noise.
  constexpr double kReachSigmas = 4.0;
  const double reach_m =
      model.range_max_m + kReachSigmas * std::hypot(model.sigma_range_m, model.sigma_relative * model.range_max_m);
  for (int i = 0; i < model.beams; ++i) {
    const double angle =
        world_T_laser.theta_rad + scan.angle_rad(static_cast<std::size_t>(i)) + rng.normal(model.sigma_bearing_rad);
    const Point2 direction(std::cos(angle), std::sin(angle));
    const auto hit = scene.nearest(world_T_laser.translation(), direction, reach_m, model.height_m);
    scan.ranges_m.push_back(laser_range(model, hit, rng));
    if (model.quality_max > 0) {
      scan.quality.push_back(laser_quality(model, hit, scan.ranges_m.back()));
    }
  }
  return scan;
}

SonarScan ping(const SonarModel& model, const Scene& scene, const Pose2& world_T_base, RobotTime stamp, Rng& rng) {
  SonarScan scan;
  scan.stamp = stamp;
  scan.range_max_m = model.range_max_m;
  scan.cone_half_angle_rad = model.cone_half_angle_rad;
  for (const Pose2& base_T_sonar : model.base_T_sonar) {
    const auto echo_m = nearest_echo_m(model, scene, world_T_base * base_T_sonar);
    scan.readings.push_back({base_T_sonar, sonar_range(model, echo_m, rng)});
  }
  return scan;
}

}  // namespace seeker::sim
