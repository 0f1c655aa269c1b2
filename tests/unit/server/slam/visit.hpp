/// \file
/// Scans for the tests of the map's backend.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "server/slam/map_backend.hpp"
#include "tests/unit/server/slam/rooms.hpp"

namespace seeker::slam {

/// A robot that walks about in a room and keeps each scan, as the tracker gives it to the backend.
class Visit {
 public:
  explicit Visit(std::uint64_t seed, std::vector<Wall> walls = furnished_room())
      : walls_(std::move(walls)), rng_(seed) {}

  void rearrange(std::vector<Wall> walls) { walls_ = std::move(walls); }

  /// Keeps scans from so many places in the newest local map, whose frame truly lies at `map_T_node`.
  void look(MapBackend& backend, const Pose2& map_T_node, int scans) {
    LocalMap& map = backend.newest();
    for (int k = 0; k < scans; ++k, time_s_ += 0.5) {
      const Pose2 node_T_base{0.1 * (k % 5), 0.15 * (k % 3), 0.7 * k};
      const LaserScan scan = scan_at(walls_, map_T_node * node_T_base, time_s_, rng_);
      map.keyframes.push_back(pack_keyframe(scan, map.id, node_T_base));
    }
  }
  [[nodiscard]] RobotTime now() const { return robot_time_s(time_s_); }

 private:
  std::vector<Wall> walls_;
  Rng rng_;
  double time_s_ = 0.0;
};

}  // namespace seeker::slam
