/// \file
/// Walls of one map against the occupied cells of another: distance after the rigid motion that fits them best.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <ostream>
#include <vector>

#include "common/core/grid.hpp"
#include "common/core/pose2.hpp"
#include "common/core/result.hpp"
#include "server/lab/scoring/score_ros_map.hpp"

namespace seeker::lab {

struct MapScoreParams {
  double sample_m = 0.05;            ///< walls are measured at points this far apart
  double coarse_step_m = 0.25;       ///< of the search over the whole map
  double coarse_step_rad = 0.04363;  ///< 2.5 degrees
  std::size_t coarse_points = 150;   ///< points looked at in that search
  double coarse_cap_m = 0.8;    ///< a point farther off than this counts as this far, so that clutter does not pull
  std::size_t candidates = 40;  ///< places that are refined
  double fine_cap_m = 0.3;
  double fine_step_m = 0.002;  ///< refined to this
  double fine_step_rad = 0.0005;
  double near_m = 0.1;           ///< for the share of near points
  std::optional<Pose2> initial;  ///< look here only: reference_T_map, to within the next two
  double initial_range_m = 1.0;
  double initial_range_rad = 0.35;
};

struct MapScore {
  std::uint64_t points = 0;
  double median_m = 0.0;
  double mean_m = 0.0;  ///< of the points within fine_cap_m
  double p90_m = 0.0;
  double near_share = 0.0;   ///< points within near_m of an occupied cell
  double known_share = 0.0;  ///< points that fall on known cells: few of them, and the fit means little
  Pose2 reference_T_map;
};

/// Distance of each point to the nearest occupied cell, after the best motion found by search and refinement.
/// kInvalidArgument: no points.
[[nodiscard]] Result<MapScore> score_map(const std::vector<Point2>& points_map, const RosMap& reference,
                                         const MapScoreParams& params = {});

struct ScoreMapOptions {
  std::filesystem::path walls;     ///< GeoJSON, or lines of points or segments
  std::filesystem::path map_yaml;  ///< of a ROS map
  MapScoreParams params;
  bool json = false;
};

/// Prints the score to `out`, and what was skipped to `notes`. Errors of the files.
[[nodiscard]] Status run_score_map(const ScoreMapOptions& options, std::ostream& out, std::ostream& notes);

}  // namespace seeker::lab
