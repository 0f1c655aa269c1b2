/// \file
/// The layer of a map picture that shows the topologies of one or several robots.
#pragma once

#include "common/image/canvas.hpp"
#include "common/image/map_view.hpp"

namespace seeker::image {

/// Draws each topology in a colour of its own, in the order of series_colour(): edges as lines, nodes as discs, goals
/// as rings, a dashed line from the robot to the goal that it drives to, and the robot with its name.
void draw_topologies(Canvas& canvas, const MapView& view, const std::vector<RobotTopology>& topologies,
                     double robot_radius_m);

/// Draws the admissible space tree of a node (spec S4.1, as the paper's Fig 3): an arc for each section at its
/// distance, and a branch from its middle to that of the section which contains it.
void draw_space_tree(Canvas& canvas, const MapView& view, const TopologyNode& node);

// The signs of draw_topologies() for its legend.
void draw_topology_node(Canvas& canvas, const Point2& at_px, Colour colour);
void draw_topology_goal(Canvas& canvas, const Point2& at_px, Colour colour);

}  // namespace seeker::image
