/// \file
/// The picture of a search: the map with what was searched, what was found and what was left out.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/core/grid.hpp"
#include "common/core/image.hpp"
#include "common/core/polygon.hpp"
#include "common/core/result.hpp"
#include "common/core/topology.hpp"

namespace seeker::image {

/// A detected target. All points in the frame `map`.
struct DetectionMark {
  std::string name;
  std::optional<Point2> position;
  Matrix2 covariance = Matrix2::Zero();  ///< of the position, m^2
  Point2 seen_from = Point2::Zero();
  double bearing_map_rad = 0.0;
};

/// A connected area of floor that the search left out.
struct GapMark {
  Point2 centre = Point2::Zero();
  double area_m2 = 0.0;
  std::string reason;
};

/// Everything the picture can show, in the frame `map`; what is empty is left out, of the legend too.
struct MapScene {
  std::string title;
  std::vector<std::pair<std::string, std::string>> facts;  ///< name and value, listed beside the map

  std::optional<Grid<std::uint8_t>> occupancy;  ///< probability of occupied * 254, 255 unknown
  std::optional<Grid<std::uint8_t>> evidence;   ///< probability of having been seen * 254, 255 no reachable floor
  std::vector<GapMark> gaps;

  double cell_size_m = 0.8;         ///< of the lists below
  std::vector<Point2> searched;     ///< centres, in the order of the visits
  std::vector<Point2> unsearched;   ///< centres
  std::vector<Point2> unreachable;  ///< centres

  std::vector<Pose2> trajectory;
  std::vector<Point2> planned_path;
  std::vector<Point2> scan;  ///< laser points
  std::optional<Pose2> robot;
  double robot_radius_m = 0.25;
  std::optional<Polygon> bound;
  std::vector<Polygon> keep_out;
  std::vector<DetectionMark> detections;
  std::vector<RobotTopology> topologies;   ///< of one or several robots, each drawn with its robot
  std::optional<TopologyNode> space_tree;  ///< the node whose admissible space tree is drawn
};

struct MapPictureOptions {
  int largest_side_px = 1100;  ///< of the map; the panel with title, figures and legend comes beside it
  double margin_m = 0.4;       ///< around what is known
};

/// The gaps as pictures and lists number them from 1: the largest first, without those that would read 0.0 m².
[[nodiscard]] std::vector<GapMark> listed_gaps(std::vector<GapMark> gaps);

/// What the panel says below its heading "gaps: N": number, reason and area of each that has a number on the map, then
/// how many there are more.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> gap_rows(const std::vector<GapMark>& listed);

/// Draws the scene. Error: kNotReady when it holds nothing that has a place; kTooLarge beyond 5 km.
[[nodiscard]] Result<Image> draw_map(const MapScene& scene, const MapPictureOptions& options = {});
/// draw_map() as an SVG document; the grids in it are pixels.
[[nodiscard]] Result<std::string> map_svg(const MapScene& scene, const MapPictureOptions& options = {});

}  // namespace seeker::image
