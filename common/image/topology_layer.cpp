#include "common/image/topology_layer.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "common/core/angle.hpp"
#include "common/image/map_layers.hpp"

namespace seeker::image {
namespace {

constexpr double kEdgeWidth_px = 1.8;
constexpr double kNode_px = 4.5;
constexpr double kGoal_px = 5.5;

void draw_edges(Canvas& canvas, const MapView& view, const Topology& topology, Colour colour) {
  std::map<std::uint64_t, Point2> places;
  for (const TopologyNode& node : topology.nodes) {
    places[node.id] = node.map_T_base.translation();
  }
  for (const TopologyEdge& edge : topology.edges) {
    const auto a = places.find(edge.a);
    const auto b = places.find(edge.b);
    if (a != places.end() && b != places.end()) {
      canvas.line(view.to_px(a->second), view.to_px(b->second), {colour, kEdgeWidth_px, LineStyle::kSolid, 0.8});
    }
  }
}

Point2 at_direction(const TopologyNode& node, const FreeSector& sector, double angle_rad) {
  return node.map_T_base * (sector.from_base + sector.radius_m * Point2(std::cos(angle_rad), std::sin(angle_rad)));
}

double middle_rad(const FreeSector& sector) { return sector.start_rad + 0.5 * sector.span_rad; }

/// The section of the next smaller distance that contains the middle of `sector`; null: it begins at the scanner.
const FreeSector* parent_of(const TopologyNode& node, const FreeSector& sector) {
  const FreeSector* parent = nullptr;
  for (const FreeSector& other : node.sectors) {
    const double from_start_rad = wrap_angle(middle_rad(sector) - other.start_rad);
    const double inside_rad = from_start_rad < 0.0 ? from_start_rad + kTwoPi : from_start_rad;
    if (other.radius_m < sector.radius_m && other.from_base == sector.from_base && inside_rad <= other.span_rad &&
        (parent == nullptr || parent->radius_m < other.radius_m)) {
      parent = &other;
    }
  }
  return parent;
}

void draw_robot_of(Canvas& canvas, const MapView& view, const RobotTopology& robot, double radius_m, Colour colour) {
  const Point2 at = view.to_px(robot.map_T_base.translation());
  if (robot.target_map) {
    canvas.line(at, view.to_px(*robot.target_map), {colour, kEdgeWidth_px, LineStyle::kDashed, 0.9});
  }
  draw_robot(canvas, view, robot.map_T_base, radius_m);
  constexpr double kText_px = 9.5;
  const double beside_px = std::max(9.0, radius_m * view.px_per_m) + 4.0;
  canvas.text(at + Point2(beside_px, -beside_px), robot.robot_id, {colour, kText_px, Anchor::kLeft, false, kWhite});
}

}  // namespace

void draw_topology_node(Canvas& canvas, const Point2& at_px, Colour colour) {
  canvas.fill_circle(at_px, kNode_px, colour);
  canvas.circle(at_px, kNode_px, {kWhite, 1.0});
}

void draw_topology_goal(Canvas& canvas, const Point2& at_px, Colour colour) {
  canvas.circle(at_px, kGoal_px, {colour, 1.8});
}

void draw_space_tree(Canvas& canvas, const MapView& view, const TopologyNode& node) {
  for (const FreeSector& sector : node.sectors) {
    constexpr double kStep_rad = deg_to_rad(2.0);
    const int steps = 1 + static_cast<int>(sector.span_rad / kStep_rad);
    std::vector<Point2> arc;
    for (int k = 0; k <= steps; ++k) {
      arc.push_back(view.to_px(at_direction(node, sector, sector.start_rad + sector.span_rad * k / steps)));
    }
    canvas.polyline(arc, look::kSpaceTree);
    const FreeSector* parent = parent_of(node, sector);
    const Point2 from = parent != nullptr ? at_direction(node, *parent, middle_rad(*parent))
                                          : Point2(node.map_T_base * sector.from_base);
    Stroke branch = look::kSpaceTree;
    branch.style = LineStyle::kDotted;
    canvas.line(view.to_px(from), view.to_px(at_direction(node, sector, middle_rad(sector))), branch);
  }
}

void draw_topologies(Canvas& canvas, const MapView& view, const std::vector<RobotTopology>& topologies,
                     double robot_radius_m) {
  for (std::size_t n = 0; n < topologies.size(); ++n) {
    const Colour colour = series_colour(n);
    draw_edges(canvas, view, topologies[n].topology, colour);
    for (const TopologyNode& node : topologies[n].topology.nodes) {
      draw_topology_node(canvas, view.to_px(node.map_T_base.translation()), colour);
      for (const TopologyGoal& goal : node.goals) {
        draw_topology_goal(canvas, view.to_px(goal.p_map), colour);
      }
    }
  }
  // Robots last, so that no other robot's edges cross them.
  for (std::size_t n = 0; n < topologies.size(); ++n) {
    draw_robot_of(canvas, view, topologies[n], robot_radius_m, series_colour(n));
  }
}

}  // namespace seeker::image
