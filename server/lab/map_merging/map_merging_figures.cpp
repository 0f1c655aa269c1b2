#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/angle.hpp"
#include "common/image/plot.hpp"
#include "server/lab/map_merging/reproduce_map_merging.hpp"

namespace seeker::lab {
namespace {

constexpr int kSide_px = 900;
constexpr double kArcStep_rad = deg_to_rad(2.0);

Point2 on_arc(const fleet::SpaceTree& tree, double radius_m, double angle_rad) {
  return tree.base_T_laser.translation() + radius_m * Point2(std::cos(angle_rad), std::sin(angle_rad));
}

void add_point(image::Series& series, const Point2& p) {
  series.x.push_back(p.x());
  series.y.push_back(p.y());
}

/// Ends a line of a series, so that the next point begins another.
void lift_pen(image::Series& series) { add_point(series, Point2::Constant(std::nan(""))); }

void add_arc(image::Series& series, const fleet::SpaceTree& tree, const fleet::SpaceSection& section) {
  const int steps = 1 + static_cast<int>(section.span_rad / kArcStep_rad);
  for (int k = 0; k <= steps; ++k) {
    add_point(series, on_arc(tree, section.radius_m, section.start_rad + section.span_rad * k / steps));
  }
  lift_pen(series);
}

/// From the middle of a section to that of the one it lies in.
void add_branch(image::Series& series, const fleet::SpaceTree& tree, const fleet::SpaceSection& section) {
  if (!section.parent) {
    return;
  }
  const fleet::SpaceSection& parent = tree.sections[*section.parent];
  add_point(series, on_arc(tree, section.radius_m, section.start_rad + 0.5 * section.span_rad));
  add_point(series, parent.layer == 0 ? tree.base_T_laser.translation()
                                      : on_arc(tree, parent.radius_m, parent.start_rad + 0.5 * parent.span_rad));
  lift_pen(series);
}

}  // namespace

Image tree_figure(const LaserScan& scan, const fleet::SpaceTree& tree, const fleet::SpaceTreeParams& params) {
  using image::SeriesStyle;
  image::Series hits{.name = "laser", .x = {}, .y = {}, .style = SeriesStyle::kPoints};
  for (const Point2& p : points_in_base(scan)) {
    add_point(hits, p);
  }
  image::Series sections{.name = "sections", .x = {}, .y = {}};
  image::Series branches{.name = "tree", .x = {}, .y = {}, .line = image::LineStyle::kDotted};
  for (const fleet::SpaceSection& section : tree.sections) {
    add_branch(branches, tree, section);
    if (section.layer > 0) {
      add_arc(sections, tree, section);
    }
  }
  image::Series goals{.name = "possible goals", .x = {}, .y = {}, .style = SeriesStyle::kPoints};
  for (const fleet::SpaceGoal& goal : tree.goals) {
    add_point(goals, goal.p_base);
  }
  image::Series main{.name = "main goal", .x = {}, .y = {}, .style = SeriesStyle::kLineAndPoints};
  if (tree.main_goal) {
    add_point(main, Point2::Zero());
    add_point(main, tree.goals[*tree.main_goal].p_base);
  }
  image::Chart chart;
  chart.title = "Admissible space tree, " + std::to_string(params.layers) + " layers";
  chart.x_label = "ahead, m";
  chart.y_label = "left, m";
  chart.equal_scale = true;
  chart.series = {std::move(hits), std::move(sections), std::move(branches), std::move(goals), std::move(main)};
  return image::draw_chart(chart, kSide_px, kSide_px);
}

Image load_figure(const std::vector<LoadSample>& keyframe, const std::vector<LoadSample>& frame) {
  image::Series frames{.name = "FRAME", .x = {}, .y = {}};
  image::Series keyframes{.name = "KEYFRAME", .x = {}, .y = {}};
  image::Series nodes{.name = "node", .x = {}, .y = {}, .style = image::SeriesStyle::kPoints};
  for (const LoadSample& sample : frame) {
    add_point(frames, {sample.time_s, sample.cpu_s});
  }
  for (const LoadSample& sample : keyframe) {
    add_point(keyframes, {sample.time_s, sample.cpu_s});
    if (sample.node) {
      add_point(nodes, {sample.time_s, 0.0});
    }
  }
  image::Chart chart;
  chart.title = "Processor time of a second of robot time";
  chart.x_label = "time, s";
  chart.y_label = "processor time, s";
  chart.series = {std::move(frames), std::move(keyframes), std::move(nodes)};
  return image::draw_chart(chart);
}

Image merged_figure(const FleetResult& run) {
  using image::SeriesStyle;
  image::Chart chart;
  chart.title = "Maps of " + std::to_string(run.robots) + " robots with their nodes, seed " + std::to_string(run.seed);
  chart.x_label = "x, m";
  chart.y_label = "y, m";
  chart.equal_scale = true;
  for (const FleetDrawing& robot : run.drawings) {
    image::Series walls{.name = robot.id + ": walls", .x = {}, .y = {}};
    for (const MapSegment& segment : robot.segments) {
      add_point(walls, robot.main_T_map * segment.left());
      add_point(walls, robot.main_T_map * segment.right());
      lift_pen(walls);
    }
    image::Series path{.name = "path", .x = {}, .y = {}, .line = image::LineStyle::kDotted};
    for (const Pose2& pose : robot.path) {
      add_point(path, robot.main_T_map * pose.translation());
    }
    image::Series nodes{.name = "nodes", .x = {}, .y = {}, .style = SeriesStyle::kPoints};
    for (const TopologyNode& node : robot.topology.nodes) {
      add_point(nodes, robot.main_T_map * node.map_T_base.translation());
    }
    chart.series.push_back(std::move(walls));
    chart.series.push_back(std::move(path));
    chart.series.push_back(std::move(nodes));
  }
  return image::draw_chart(chart, kSide_px, kSide_px);
}

}  // namespace seeker::lab
