#include "server/explore/leg_forecast.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/angle.hpp"
#include "server/explore/trail.hpp"

namespace seeker::explore {
namespace {

/// Looks along a path: so far apart, and no more than so many.
constexpr double kLookEvery_m = 1.0;
constexpr std::size_t kMaxLooks = 8;
/// Speeds of the predicted drive: what counts is the noise by distance and angle.
constexpr double kSpeed_m_s = 0.3;
constexpr double kRotation_rad_s = 0.5;
/// Walls farther away from the robot than this and the sensor's range say nothing of a leg.
constexpr double kReach_m = 15.0;

/// Poses along a path, each looking where it leads; the last one as the view wants it.
std::vector<Pose2> looks_along(const nav::Path& path, const Pose2& last) {
  const double step_m = std::max(kLookEvery_m, path.length_m / static_cast<double>(kMaxLooks));
  std::vector<Pose2> looks;
  double to_go_m = step_m;
  for (std::size_t k = 1; k < path.waypoints.size(); ++k) {
    const Point2 from = path.waypoints[k - 1];
    const Point2 leg = path.waypoints[k] - from;
    const double length_m = leg.norm();
    for (; to_go_m < length_m; to_go_m += step_m) {
      const Point2 p = from + to_go_m / length_m * leg;
      looks.push_back({p.x(), p.y(), std::atan2(leg.y(), leg.x())});
    }
    to_go_m -= length_m;
  }
  looks.push_back(last);
  return looks;
}

std::vector<Pose2> looks_on_way(const PlaceInput& input, const Opening& opening) {
  const auto path = input.costs.path_to(input.floor.cost, opening.map_T_view.translation());
  return looks_along(path ? *path : nav::Path{}, opening.map_T_view);
}

void move_to(PredictedBelief& belief, const Pose2& from, const Pose2& to, const slam::OdometryParams& odometry) {
  const double rotation_rad = wrap_angle(to.theta_rad - from.theta_rad);
  belief.move(predict_motion({0.0, std::copysign(kRotation_rad_s, rotation_rad)},
                             std::abs(rotation_rad) / kRotation_rad_s, odometry));
  belief.move(predict_motion({kSpeed_m_s, 0.0}, distance_m(from, to) / kSpeed_m_s, odometry));
}

}  // namespace

SightScene forecast_scene(const PlaceInput& input, const OneStepParams& params) {
  return {input.robot.segments, input.robot.map_T_base.translation(), kReach_m + params.sensor.range_m, params,
          params.use_floor ? &input.floor.cost.states() : nullptr};
}

Belief forecast_belief(const StrategyInput& robot, const OneStepParams& params) {
  return robot.belief ? Belief(*robot.belief)
                      : Belief(robot.map_T_base, robot.covariance, robot.segments,
                               static_cast<std::size_t>(params.max_observed));
}

LegForecast forecast_leg(const PlaceInput& input, const Opening& opening, const SightScene& scene, const Belief& belief,
                         const OneStepParams& params) {
  const std::vector<Pose2> looks = looks_on_way(input, opening);
  std::vector<std::vector<PredictedSight>> sights;
  std::vector<std::size_t> walls;
  sights.reserve(looks.size());
  for (const Pose2& look : looks) {
    sights.push_back(predict_sights(belief, scene.look(look), params.max_observed));
    for (const PredictedSight& sight : sights.back()) {
      const bool room = walls.size() < static_cast<std::size_t>(params.max_observed);
      if (room && std::find(walls.begin(), walls.end(), sight.wall) == walls.end()) {
        walls.push_back(sight.wall);
      }
    }
  }
  PredictedBelief then = belief.joint(walls);
  LegForecast forecast;
  for (std::size_t k = 0; k < looks.size(); ++k) {
    move_to(then, k == 0 ? input.robot.map_T_base : looks[k - 1], looks[k], params.odometry);
    forecast.worst_sigma_m = std::max(forecast.worst_sigma_m, position_sigma_m(then.robot_covariance()));
    then.observe(belief, looks[k], sights[k], params.sensor);
  }
  forecast.uncertainty = then.uncertainty();
  return forecast;
}

LegForecast forecast_blind_leg(const PlaceInput& input, const Opening& opening, const OneStepParams& params) {
  const std::vector<MapSegment> no_walls;
  PredictedBelief then = Belief(input.robot.map_T_base, input.robot.covariance, no_walls, 0).joint({});
  LegForecast forecast;
  Pose2 from = input.robot.map_T_base;
  for (const Pose2& look : looks_on_way(input, opening)) {
    move_to(then, from, look, params.odometry);
    forecast.worst_sigma_m = std::max(forecast.worst_sigma_m, position_sigma_m(then.robot_covariance()));
    from = look;
  }
  return forecast;
}

}  // namespace seeker::explore
