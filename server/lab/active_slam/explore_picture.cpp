#include "server/lab/active_slam/explore_picture.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "common/core/angle.hpp"
#include "common/image/map_layers.hpp"
#include "common/image/plot.hpp"
#include "server/lab/experiments/table.hpp"
#include "server/lab/plots/image_tools.hpp"
#include "server/lab/plots/world_sheet.hpp"

namespace seeker::lab {
namespace {

constexpr image::Stroke kTruth{{205, 205, 200}, 5.0};
constexpr image::Stroke kFurniture{{226, 220, 208}, 2.0};
constexpr image::Stroke kMissing{image::kRed, 3.0};
constexpr image::Stroke kMapped{image::look::kWall, 1.8};
constexpr image::Stroke kEdge{image::kOrange, 1.0};
constexpr image::Stroke kGoal{image::kRed, 1.5};
constexpr double kNode_px = 5.0;
constexpr image::Stroke kFree{image::kBlue, 1.6};
constexpr image::Stroke kAlongWall{image::kPurple, 2.2, image::LineStyle::kDashDot};

void draw_truth(WorldSheet& sheet, const ExploreRecord& record) {
  for (const sim::Segment& wall : record.truth_walls.walls) {
    sheet.line(wall.a, wall.b(), kTruth);
  }
  for (const sim::Segment& face : record.truth_walls.furniture) {
    sheet.line(face.a, face.b(), kFurniture);
  }
}

void draw_map(WorldSheet& sheet, const ExploreRecord& record) {
  for (const MapSegment& segment : record.segments) {
    sheet.line(record.walls.world_T_map * segment.left(), record.walls.world_T_map * segment.right(), kMapped);
  }
  for (const WallPiece& piece : record.walls.missing) {
    const Point2 along = 0.5 * piece.length_m * Point2(-piece.normal.y(), piece.normal.x());
    sheet.line(piece.p_world - along, piece.p_world + along, kMissing);
  }
  for (const Point2& p_map : record.unreachable) {
    const double side_px = 0.4 * sheet.px_per_m();
    image::draw_cell(sheet.canvas(), sheet.px(record.walls.world_T_map * p_map), side_px, image::look::kUnreachable,
                     true);
  }
}

/// Draws the nodes, the paths between them, and goals that were left.
void draw_topology(WorldSheet& sheet, const ExploreRecord& record) {
  std::map<std::uint64_t, Point2> nodes;
  for (const TopologyNode& node : record.topology.nodes) {
    nodes[node.id] = sheet.px(record.walls.world_T_map * node.map_T_base.translation());
  }
  for (const TopologyEdge& edge : record.topology.edges) {
    sheet.canvas().line(nodes.at(edge.a), nodes.at(edge.b), kEdge);
  }
  for (const TopologyNode& node : record.topology.nodes) {
    sheet.canvas().fill_circle(nodes.at(node.id), kNode_px, image::kOrange);
    for (const TopologyGoal& goal : node.goals) {
      sheet.canvas().circle(sheet.px(record.walls.world_T_map * goal.p_map), kNode_px, kGoal);
    }
  }
}

/// Draws the path in long pieces, because a dash pattern must not start again at every step.
void draw_path(WorldSheet& sheet, const ExploreRecord& record) {
  const std::vector<PathPlace>& path = record.true_path;
  for (std::size_t begin = 0; begin < path.size();) {
    std::size_t end = begin;
    std::vector<Point2> stretch;
    while (end < path.size() && path[end].along_wall == path[begin].along_wall) {
      stretch.push_back(sheet.px(path[end++].p_world));
    }
    if (end < path.size()) {
      stretch.push_back(sheet.px(path[end].p_world));
    }
    sheet.canvas().polyline(stretch, path[begin].along_wall ? kAlongWall : kFree);
    begin = end;
  }
  const auto robot = [&](const Pose2& pose, const image::Colour& colour) {
    const Point2 at = sheet.px(pose.translation());
    sheet.canvas().circle(at, record.robot_radius_m * sheet.px_per_m(), {colour, 1.8});
    sheet.canvas().line(at, sheet.px(pose * Point2(record.robot_radius_m, 0.0)), {colour, 1.8});
  };
  robot(record.truth.world_T_start, image::kGrey);
  robot(record.truth.world_T_base, image::look::kRobot);
}

void draw_text(WorldSheet& sheet, const ExploreRecord& record, const std::string& title) {
  const ExploreResult& r = record.result;
  const std::string facts = r.outcome + " after " + fixed(r.robot_time_s, 0) + " s, path " + fixed(r.path_length_m, 1) +
                            " m, walls mapped " + fixed(100.0 * r.wall_share, 1) + " % of " +
                            fixed(r.reachable_wall_m, 1) + " m, false " + fixed(r.false_wall_m, 1) + " m";
  const std::string errors = "position error: mean " + fixed(r.mean_error_m, 3) + " m, largest " +
                             fixed(r.max_error_m, 3) + " m; contacts " + std::to_string(r.contacts) +
                             ", least clearance " + fixed(r.min_clearance_m, 2) + " m; loops closed: epoch " +
                             std::to_string(r.map_epoch);
  sheet.head(title, {facts, errors});
  std::vector<LegendEntry> legend = {{"true wall", kTruth},
                                     {"mapped", kMapped},
                                     {"not mapped", kMissing},
                                     {"path", kFree},
                                     {"path along a wall", kAlongWall}};
  if (!record.topology.nodes.empty()) {
    legend.push_back({"node", kEdge});
  }
  sheet.foot(legend);
}

using Curve = double ExploreSample::*;

/// What an axis of a figure shows.
struct Axis {
  const char* label;
  Curve curve;
};
constexpr Axis kTime{"time, s", &ExploreSample::time_s};

image::Chart chart_of(const std::string& title, const std::vector<NamedCurve>& curves, const Axis& x, const Axis& y) {
  image::Chart chart;
  chart.title = title;
  chart.x_label = x.label;
  chart.y_label = y.label;
  for (const NamedCurve& named : curves) {
    image::Series series{.name = named.name, .x = {}, .y = {}};
    for (const ExploreSample& sample : named.samples) {
      series.x.push_back(sample.*x.curve);
      series.y.push_back(sample.*y.curve);
    }
    chart.series.push_back(std::move(series));
  }
  return chart;
}

}  // namespace

Image draw_exploration(const ExploreRecord& record, const std::string& title) {
  WorldSheet sheet(record.world, {});
  draw_truth(sheet, record);
  draw_map(sheet, record);
  draw_topology(sheet, record);
  draw_path(sheet, record);
  draw_text(sheet, record, title);
  return sheet.canvas().image();
}

Image error_figure(const std::string& title, const std::vector<NamedCurve>& curves) {
  return image::draw_chart(chart_of(title, curves, kTime, {"position error, m", &ExploreSample::error_m}));
}

Image trace_figure(const std::string& title, const std::vector<NamedCurve>& curves) {
  const auto chart = [&](const std::string& what, Curve curve) {
    constexpr int kWidth_px = 900;
    constexpr int kHeight_px = 380;
    return image::draw_chart(chart_of(title + ": " + what, curves, kTime, {"trace", curve}), kWidth_px, kHeight_px);
  };
  return contact_sheet({{"", chart("robot and segments", &ExploreSample::full_trace)},
                        {"", chart("robot (x, y, theta)", &ExploreSample::robot_trace)},
                        {"", chart("mean of a segment", &ExploreSample::feature_trace)}},
                       1);
}

Image floor_figure(const std::string& title, const std::vector<NamedCurve>& curves) {
  return image::draw_chart(
      chart_of(title, curves, {"path, m", &ExploreSample::path_m}, {"floor, m\xC2\xB2", &ExploreSample::floor_m2}));
}

}  // namespace seeker::lab
