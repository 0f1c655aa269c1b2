/// \file
/// Walls and a robot that sees them as segment observations with exactly the noise it claims: for tests of the SPmap.
#pragma once

#include <cmath>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "common/core/angle.hpp"
#include "common/core/pose2.hpp"
#include "common/core/rng.hpp"
#include "server/lines/observation.hpp"
#include "server/slam/sp_geometry.hpp"
#include "server/slam/sp_map.hpp"

namespace seeker::slam::test {

/// A wall: frame at its middle, y into it.
struct TrueWall {
  Pose2 map_T_wall;
  double length_m = 0.0;
};

/// The wall from its left end (seen from the robot's side) to its right end.
inline TrueWall wall_between(const Point2& left, const Point2& right) {
  const Point2 d = right - left;
  return {{0.5 * (left.x() + right.x()), 0.5 * (left.y() + right.y()), std::atan2(d.y(), d.x())}, d.norm()};
}

/// A room with its middle at the origin, seen from inside.
inline std::vector<TrueWall> room(double width_m = 8.0, double depth_m = 6.0) {
  const double w = 0.5 * width_m;
  const double d = 0.5 * depth_m;
  return {wall_between({-w, d}, {w, d}), wall_between({w, d}, {w, -d}), wall_between({w, -d}, {-w, -d}),
          wall_between({-w, -d}, {-w, d})};
}

struct SensorNoise {
  double y_m = 0.01;
  double theta_rad = 0.01;
  double end_m = 0.03;
};

/// Noise of p_O, drawn as the covariance says.
inline Vector4 draw_p(const SensorNoise& noise, Rng& rng) {
  return {rng.normal(noise.y_m), rng.normal(noise.theta_rad), rng.normal(noise.end_m), rng.normal(noise.end_m)};
}

/// The part of a wall between `from_m` and `to_m` of its x axis, seen with perturbation p: eq (8) turned round.
inline lines::SegmentObservation see(const Pose2& map_T_base, const TrueWall& wall, double from_m, double to_m,
                                     const std::array<bool, 2>& real, const SensorNoise& noise, const Vector4& p) {
  const double left = real[0] ? p(2) : 0.0;
  const double right = real[1] ? p(3) : 0.0;
  lines::SegmentObservation observation;
  const Pose2 base_T_part = inverse(map_T_base) * wall.map_T_wall * Pose2{0.5 * (from_m + to_m), 0.0, 0.0};
  observation.base_T_segment = base_T_part * Pose2{-0.5 * (left + right), 0.0, 0.0} * inverse(Pose2{0.0, p(0), p(1)});
  observation.length_m = to_m - from_m + left - right;
  observation.real = real;
  observation.covariance << noise.y_m * noise.y_m, 0.0, 0.0, noise.theta_rad * noise.theta_rad;
  observation.end_sigma_m = {noise.end_m, noise.end_m};
  observation.points = 40;
  return observation;
}

inline lines::SegmentObservation see_whole(const Pose2& map_T_base, const TrueWall& wall, const SensorNoise& noise,
                                           Rng& rng) {
  return see(map_T_base, wall, -0.5 * wall.length_m, 0.5 * wall.length_m, {true, true}, noise, draw_p(noise, rng));
}

/// Increment of the odometry that is off by `noise` (of d in the new frame).
struct OdometryNoise {
  double x_m = 0.02;
  double y_m = 0.01;
  double theta_rad = 0.01;
};
inline Matrix3 covariance_of(const OdometryNoise& noise) {
  return Eigen::Vector3d(noise.x_m * noise.x_m, noise.y_m * noise.y_m, noise.theta_rad * noise.theta_rad)
      .asDiagonal()
      .toDenseMatrix();
}
/// The true motion, given that `increment` was measured: increment (+) d.
inline Pose2 true_motion(const Pose2& increment, const OdometryNoise& noise, Rng& rng) {
  return increment * Pose2{rng.normal(noise.x_m), rng.normal(noise.y_m), rng.normal(noise.theta_rad)};
}

/// Every observation is of the segment with the number in `ids`; 0: new.
inline Association known(const std::vector<SegmentId>& ids, const std::vector<lines::SegmentObservation>& observations,
                         const SpMap& map) {
  Association association;
  for (std::size_t k = 0; k < ids.size(); ++k) {
    SpMatch match;
    if (const SpSegment* segment = map.find(ids[k])) {
      match.verdict = SpVerdict::kPaired;
      match.segment = ids[k];
      match.ends = {segment->real[0] && observations[k].real[0], segment->real[1] && observations[k].real[1]};
    }
    association.matches.push_back(match);
  }
  return association;
}

/// Squared error of the robot in units of its own covariance; 3 on average.
inline double robot_nees(const SpMap& map, const Pose2& truth) {
  const Pose2 d = inverse(map.robot()) * truth;
  const Eigen::Vector3d error(d.x_m, d.y_m, d.theta_rad);
  return error.dot(map.robot_covariance().inverse() * error);
}

/// That of a segment, as many as it has rows on average. The wall is an infinite line; only real ends count.
inline double segment_nees(const SpMap& map, const SpSegment& segment, const TrueWall& wall) {
  const Pose2 d = inverse(segment.map_T_segment) * wall.map_T_wall;
  const SegmentCovariance covariance = map.segment_covariance(segment.id);
  Eigen::VectorXd error(covariance.rows());
  error(0) = d.y_m - d.x_m * std::tan(d.theta_rad);
  error(1) = d.theta_rad;
  Eigen::Index row = 2;
  for (std::size_t side = 0; side < 2; ++side) {
    if (segment.real[side]) {
      const Point2 end = d * Point2(0.5 * end_sign(side) * wall.length_m, 0.0);
      const Point2 foot(0.0, error(0));
      const Point2 along(std::cos(error(1)), std::sin(error(1)));
      error(row++) = along.dot(end - foot) - 0.5 * end_sign(side) * segment.length_m;
    }
  }
  return error.dot(covariance.ldlt().solve(error));
}

}  // namespace seeker::slam::test
