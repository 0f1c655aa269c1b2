#include "tests/support/maps/random_map.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/angle.hpp"

namespace seeker::testing {
namespace {

Pose2 random_pose(Rng& rng) { return {rng.uniform(-50.0, 50.0), rng.uniform(-50.0, 50.0), rng.uniform(-kPi, kPi)}; }

RobotTime random_time(Rng& rng) { return RobotTime(Duration(static_cast<std::int64_t>(rng.bits() >> 8U))); }

/// L * L^T for a random L: positive semi-definite and exactly symmetric.
template <class M>
M random_covariance(Rng& rng) {
  M factor = M::Zero();
  for (int row = 0; row < factor.rows(); ++row) {
    for (int column = 0; column <= row; ++column) {
      factor(row, column) = rng.normal(0.05);
    }
  }
  const M covariance = factor * factor.transpose();
  return (covariance + covariance.transpose()) / 2.0;
}

MapSegment wall(std::uint64_t id, const Pose2& map_T_segment, double length_m) {
  constexpr double kSigma_m = 0.01;
  constexpr double kSigma_rad = 0.002;
  MapSegment segment;
  segment.id = id;
  segment.node = 1;
  segment.map_T_segment = map_T_segment;
  segment.length_m = length_m;
  segment.left_real = segment.right_real = true;
  segment.covariance = Eigen::Vector2d(kSigma_m * kSigma_m, kSigma_rad * kSigma_rad).asDiagonal();
  segment.hits = 10;
  segment.created = robot_time_s(1.0);
  segment.last_seen = robot_time_s(2.0);
  return segment;
}

}  // namespace

LineMap random_map(Rng& rng, const RandomMapSize& size) {
  LineMap map;
  map.epoch = static_cast<std::uint32_t>(rng.below(1000));
  for (std::uint32_t k = 0; k < size.nodes; ++k) {
    map.nodes.push_back({k * 3 + 1, random_pose(rng), random_time(rng)});
    if (k > 0) {
      map.edges.push_back(
          {map.nodes[k - 1].id, map.nodes[k].id, random_pose(rng), random_covariance<Matrix3>(rng), false, true});
      map.edges.push_back({map.nodes[rng.below(k)].id, map.nodes[k].id, random_pose(rng),
                           random_covariance<Matrix3>(rng), true, rng.below(2) == 0});
    }
  }
  const auto node = [&] { return map.nodes[rng.below(map.nodes.size())].id; };
  for (std::size_t k = 0; k < size.segments && size.nodes > 0; ++k) {
    map.next_id += rng.below(3);
    MapSegment segment = wall(map.next_id++, random_pose(rng), rng.uniform(0.0, 20.0));
    segment.node = node();
    segment.left_real = rng.below(2) == 0;
    segment.right_real = rng.below(2) == 0;
    segment.covariance = random_covariance<Matrix2>(rng);
    segment.hits = static_cast<std::uint32_t>(rng.bits());
    segment.created = random_time(rng);
    segment.last_seen = random_time(rng);
    map.segments.push_back(segment);
  }
  for (std::size_t k = 0; k < size.keyframes && size.nodes > 0; ++k) {
    MapKeyframe keyframe{node(), random_time(rng), random_pose(rng), random_pose(rng), -1.5F, 0.0087F, 8.0F, {}};
    for (std::size_t beam = 0; beam <= rng.below(size.beams + 1); ++beam) {
      keyframe.ranges.push_back(static_cast<std::uint16_t>(rng.bits()));
    }
    map.keyframes.push_back(std::move(keyframe));
  }
  return map;
}

LineMap room_map(double width_m, double depth_m) {
  constexpr std::size_t kBeams = 180;
  LineMap map;
  map.nodes.push_back({1, {}, robot_time_s(0.5)});
  // x along the wall, y from the room into it.
  map.segments = {wall(1, {width_m / 2.0, 0.0, -kPi / 2.0}, depth_m), wall(2, {0.0, depth_m / 2.0, 0.0}, width_m),
                  wall(3, {-width_m / 2.0, 0.0, kPi / 2.0}, depth_m), wall(4, {0.0, -depth_m / 2.0, kPi}, width_m)};
  map.next_id = 5;
  LaserScan scan;
  scan.stamp = robot_time_s(1.0);
  scan.angle_min_rad = -kPi;
  scan.angle_step_rad = kTwoPi / kBeams;
  scan.range_max_m = 2.0 * (width_m + depth_m);
  for (std::size_t beam = 0; beam < kBeams; ++beam) {
    const double angle = scan.angle_rad(beam);
    const double across = std::abs(std::cos(angle)) > 1e-9 ? width_m / 2.0 / std::abs(std::cos(angle)) : 1e9;
    const double along = std::abs(std::sin(angle)) > 1e-9 ? depth_m / 2.0 / std::abs(std::sin(angle)) : 1e9;
    scan.ranges_m.push_back(static_cast<float>(std::min(across, along)));
  }
  map.keyframes.push_back(pack_keyframe(scan, 1, {}));
  return map;
}

}  // namespace seeker::testing
