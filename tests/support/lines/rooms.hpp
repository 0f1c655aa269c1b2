/// \file
/// Rooms of straight walls, and a laser in them that knows which wall each beam hits.
#pragma once

#include <cstdint>
#include <vector>

#include "common/core/pose2.hpp"
#include "common/core/rng.hpp"
#include "common/core/scan.hpp"

namespace seeker::testing {

/// In the frame `laser`.
struct RoomWall {
  Point2 a{0.0, 0.0};
  Point2 b{0.0, 0.0};
};

/// Walls of a room as the laser has them around it.
using Room = std::vector<RoomWall>;

/// Corners in order, closed.
void add_polygon(Room& room, const std::vector<Point2>& corners);
/// A room of 10 x 7 m with five rotated boxes, seen from a random place outside the boxes under a random heading.
[[nodiscard]] Room random_room(Rng& rng);
/// The room seen by a laser that was moved.
[[nodiscard]] Room seen_from(const Room& room, const Pose2& laser_T_new);

struct ScannerModel {
  int beams = 361;
  double first_rad = -1.5707963267948966;
  double step_rad = 3.141592653589793 / 360.0;
  double sigma_m = 0.01;
  double slope = 0.0;  ///< sigma^2 = sigma_m^2 + (slope rho)^2
  double bearing_sigma_rad = 0.0;
  double range_max_m = 30.0;

  /// `beams` over half a circle, ends included; over a full circle, ends once.
  [[nodiscard]] static ScannerModel half_circle(int beams, double sigma_m);
  [[nodiscard]] static ScannerModel full_circle(int beams, double sigma_m);
};

/// A scan with its truth.
struct TrueScan {
  LaserScan scan;
  std::vector<std::int32_t> wall_of_beam;  ///< index in the room; -1: none
  std::vector<double> true_range_m;
};
[[nodiscard]] TrueScan scan_room(const Room& room, const ScannerModel& model, Rng& rng);

}  // namespace seeker::testing
