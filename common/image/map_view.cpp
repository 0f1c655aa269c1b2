#include "common/image/map_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/core/occupancy_tile.hpp"

namespace seeker::image {
namespace {

constexpr double kLargestSide_m = 5000.0;
constexpr double kSmallestSide_m = 2.0;
constexpr int kSmallestPicture_px = 64;

struct Bounds {
  Point2 low = Point2::Constant(std::numeric_limits<double>::infinity());
  Point2 high = Point2::Constant(-std::numeric_limits<double>::infinity());

  void add(const Point2& p) {
    if (p.allFinite()) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  [[nodiscard]] bool any() const { return low.x() <= high.x(); }
};

void add_grid(Bounds& bounds, const Grid<std::uint8_t>& grid) {
  CellIndex low{grid.width(), grid.height()};
  CellIndex high{-1, -1};
  for (std::size_t n = 0; n < grid.cells().size(); ++n) {
    if (grid.cells()[n] != kUnknownCell) {
      const CellIndex c = grid.cell(n);
      low = {std::min(low.i, c.i), std::min(low.j, c.j)};
      high = {std::max(high.i, c.i), std::max(high.j, c.j)};
    }
  }
  if (high.i >= 0) {
    const double half_m = grid.frame().resolution_m / 2.0;
    bounds.add(grid.frame().centre_of(low) - Point2::Constant(half_m));
    bounds.add(grid.frame().centre_of(high) + Point2::Constant(half_m));
  }
}

Bounds bounds_of(const MapScene& scene) {
  Bounds bounds;
  for (const auto* grid : {&scene.occupancy, &scene.evidence}) {
    if (*grid) {
      add_grid(bounds, **grid);
    }
  }
  for (const Pose2& pose : scene.trajectory) {
    bounds.add(pose.translation());
  }
  for (const auto* cells : {&scene.searched, &scene.unsearched, &scene.unreachable}) {
    for (const Point2& centre : *cells) {
      bounds.add(centre - Point2::Constant(scene.cell_size_m / 2.0));
      bounds.add(centre + Point2::Constant(scene.cell_size_m / 2.0));
    }
  }
  for (const DetectionMark& mark : scene.detections) {
    bounds.add(mark.position.value_or(mark.seen_from));
  }
  if (scene.robot) {
    bounds.add(scene.robot->translation());
  }
  for (const RobotTopology& robot : scene.topologies) {
    bounds.add(robot.map_T_base.translation());
    for (const TopologyNode& node : robot.topology.nodes) {
      bounds.add(node.map_T_base.translation());
    }
  }
  return bounds;
}

}  // namespace

Result<MapView> fit_view(const MapScene& scene, const MapPictureOptions& options) {
  Bounds bounds = bounds_of(scene);
  if (!bounds.any()) {
    return fail(Errc::kNotReady, "there is no map yet: nothing to draw; let the robot sense or move first");
  }
  const Point2 centre = (bounds.low + bounds.high) / 2.0;
  const Point2 half =
      ((bounds.high - bounds.low) / 2.0 + Point2::Constant(options.margin_m)).cwiseMax(kSmallestSide_m / 2.0);
  if (2.0 * half.maxCoeff() > kLargestSide_m) {
    return fail(Errc::kTooLarge, "the map spans more than 5 km; something in it lies far away");
  }
  MapView view;
  view.low = centre - half;
  view.high = centre + half;
  view.px_per_m = options.largest_side_px / (2.0 * half.maxCoeff());
  view.width_px = std::max(kSmallestPicture_px, static_cast<int>(std::lround(2.0 * half.x() * view.px_per_m)));
  view.height_px = std::max(kSmallestPicture_px, static_cast<int>(std::lround(2.0 * half.y() * view.px_per_m)));
  return view;
}

}  // namespace seeker::image
