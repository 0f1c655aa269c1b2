/// \file
/// Admissible space tree of one scan (spec S4.1): the directions that are wide enough for the robot up to which
/// distance, and the goals derived from them.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "common/core/angle.hpp"
#include "common/core/pose2.hpp"
#include "common/core/scan.hpp"

namespace seeker::fleet {

struct SpaceTreeParams {
  double corridor_width_m = 0.70;             ///< W: wider than the robot (3-AT: 0.50 m)
  int layers = 8;                             ///< number of layers between the nearest hit and the longest range
  double max_range_m = 10.0;                  ///< rho_max, upper limit where the scanner has a longer range
  double min_goal_radius_m = 1.5;             ///< layers nearer than this give no goals
  double max_goal_span_rad = deg_to_rad(60);  ///< wider sections give several goals
};

/// Consecutive directions of one layer in which the rectangle of width W is free of hits up to the layer's radius.
/// Angles are those of the base, about the laser's origin.
struct SpaceSection {
  int layer = 0;  ///< 1..layers; 0: the root, the field of view up to the nearest hit
  double radius_m = 0.0;
  double start_rad = 0.0;             ///< in (-pi, pi]
  double span_rad = 0.0;              ///< counter-clockwise from the start, 0..2 pi
  std::optional<std::size_t> parent;  ///< the section of the layer below that contains it; no value for the root
  bool leaf = true;                   ///< no section of the next layer lies in it
};

/// A position to which the robot could drive straight.
struct SpaceGoal {
  Point2 p_base = Point2::Zero();
  int layer = 1;
  std::size_t section = 0;  ///< index into SpaceTree::sections
};

struct SpaceTree {
  Pose2 base_T_laser;
  std::vector<SpaceSection> sections;  ///< by layer, then by direction
  std::vector<SpaceGoal> goals;
  /// Outermost layer, then the smallest heading change; no value without goals.
  std::optional<std::size_t> main_goal;

  /// Whether a straight corridor of width W leads from the laser to the position.
  [[nodiscard]] bool admits(const Point2& p_base) const;
};

/// Builds the tree of a valid scan. A direction is blocked at radius R by a hit at (rho, phi) when 0 < rho cos(phi -
/// direction) <= R and |rho sin(phi - direction)| <= W/2; directions outside the field of view are blocked. Sections
/// whose chord is below W/4 are dropped, together with all sections behind them. Empty for a scan without beams.
[[nodiscard]] SpaceTree build_space_tree(const LaserScan& scan, const SpaceTreeParams& params = {});

/// Layer and direction of a goal, for the choice of the main goal.
struct GoalDirection {
  int layer = 1;
  double bearing_rad = 0.0;
};
/// The main goal (spec S4.1): outermost layer first, then the smallest heading change from `heading_rad`; ties by
/// index. No value without goals.
[[nodiscard]] std::optional<std::size_t> main_goal_of(const std::vector<GoalDirection>& goals, double heading_rad);

}  // namespace seeker::fleet
