/// \file
/// Compares the walls of one map with the occupied cells of another: distances after the best rigid motion.
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
  double sample_m = 0.05;            ///< distance of the points at which walls are measured
  double coarse_step_m = 0.25;       ///< step of the search over the whole map
  double coarse_step_rad = 0.04363;  ///< 2.5 degrees
  std::size_t coarse_points = 150;   ///< number of points used in that search
  double coarse_cap_m = 0.8;         ///< larger distances count as this, so that clutter has little effect
  std::size_t candidates = 40;       ///< number of places that are refined
  double fine_cap_m = 0.3;
  double fine_step_m = 0.002;  ///< final step of the refinement
  double fine_step_rad = 0.0005;
  double near_m = 0.1;           ///< distance of points that count as near
  std::optional<Pose2> initial;  ///< search only near this reference_T_map, within the next two ranges
  double initial_range_m = 1.0;
  double initial_range_rad = 0.35;
};

struct MapScore {
  std::uint64_t points = 0;
  double median_m = 0.0;
  double mean_m = 0.0;  ///< mean over the points within fine_cap_m
  double p90_m = 0.0;
  double near_share = 0.0;   ///< share of points within near_m of an occupied cell
  double known_share = 0.0;  ///< share of points on known cells; where it is small, the fit means little
  Pose2 reference_T_map;
};

/// Distance of each point to the nearest occupied cell, after the best motion found by search and refinement.
/// kInvalidArgument: there are no points.
[[nodiscard]] Result<MapScore> score_map(const std::vector<Point2>& points_map, const RosMap& reference,
                                         const MapScoreParams& params = {});

struct ScoreMapOptions {
  std::filesystem::path walls;     ///< GeoJSON, or lines of points or segments
  std::filesystem::path map_yaml;  ///< YAML file of a ROS map
  MapScoreParams params;
  bool json = false;
};

/// Prints the score to `out`, and what was skipped to `notes`. Errors of the files.
[[nodiscard]] Status run_score_map(const ScoreMapOptions& options, std::ostream& out, std::ostream& notes);

}  // namespace seeker::lab
