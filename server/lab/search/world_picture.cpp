#include <cmath>

#include "common/core/angle.hpp"
#include "common/image/map_layers.hpp"
#include "server/lab/experiments/table.hpp"
#include "server/lab/plots/world_sheet.hpp"
#include "server/lab/search/run_picture.hpp"

namespace seeker::lab {
namespace {

constexpr WorldSheet::Layout kLayout{.largest_side_px = 960, .margin_m = 0.25, .header_px = 76};
constexpr image::Colour kFurniture{196, 190, 180};

std::vector<Point2> rectangle(const WorldSheet& sheet, const Pose2& world_T_box, double length_m, double width_m) {
  std::vector<Point2> corners;
  for (const auto& [sx, sy] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}) {
    corners.push_back(sheet.px(world_T_box * Point2(sx * length_m, sy * width_m)));
  }
  return corners;
}

void draw_world(WorldSheet& sheet, const sim::World& world) {
  for (const sim::Box& box : world.boxes) {
    const std::vector<Point2> corners = rectangle(sheet, box.world_T_box, box.length_m, box.width_m);
    sheet.canvas().fill_polygon(corners, kFurniture);
    sheet.canvas().polygon(corners, {image::kGrey, 1.0});
  }
  for (const sim::Cylinder& cylinder : world.cylinders) {
    const double radius_px = cylinder.radius_m * sheet.px_per_m();
    sheet.canvas().fill_circle(sheet.px(cylinder.centre), radius_px, kFurniture);
    sheet.canvas().circle(sheet.px(cylinder.centre), radius_px, {image::kGrey, 1.0});
  }
  for (const sim::Wall& wall : world.walls) {
    const double width_px = std::max(3.0, wall.thickness_m * sheet.px_per_m());
    sheet.canvas().line(sheet.px(wall.a), sheet.px(wall.b), {image::look::kWall, width_px});
  }
}

void draw_lists(WorldSheet& sheet, const RunRecord& record) {
  if (!record.grid) {
    return;
  }
  const api::GridLists& lists = record.grid->lists;
  const Pose2& world_T_map = record.truth.world_T_start;
  const double side_px = lists.cell_size_m * sheet.px_per_m();
  for (const Point2& p_map : lists.unsearched) {
    image::draw_cell(sheet.canvas(), sheet.px(world_T_map * p_map), side_px, image::look::kUnsearched, false);
  }
  for (const Point2& p_map : lists.unreachable) {
    image::draw_cell(sheet.canvas(), sheet.px(world_T_map * p_map), side_px, image::look::kUnreachable, true);
  }
  int number = 0;
  for (const Point2& p_map : lists.searched) {
    const Point2 at = sheet.px(world_T_map * p_map);
    image::draw_cell(sheet.canvas(), at, side_px, image::look::kSearched, false);
    sheet.canvas().text(at + Point2(-side_px / 2.0 + 4.0, -side_px / 2.0 + 13.0), std::to_string(++number),
                        {.colour = image::look::kSearched.colour, .size_px = 9.0, .halo = image::kWhite});
  }
}

void draw_path(WorldSheet& sheet, const RunRecord& record) {
  std::vector<Point2> path;
  path.reserve(record.true_path.size());
  for (const Pose2& pose : record.true_path) {
    path.push_back(sheet.px(pose.translation()));
  }
  sheet.canvas().polyline(path, image::look::kTrajectory);
  const auto robot = [&](const Pose2& pose) {
    const Point2 at = sheet.px(pose.translation());
    const double radius_px = record.robot_radius_m * sheet.px_per_m();
    sheet.canvas().fill_circle(at, radius_px, image::look::kRobot, 0.25);
    sheet.canvas().circle(at, radius_px, {image::look::kRobot, 1.5});
    const Point2 nose = sheet.px(pose * Point2(record.robot_radius_m, 0.0));
    sheet.canvas().line(at, nose, {image::look::kRobot, 2.0});
  };
  robot(record.truth.world_T_start);
  robot(record.truth.world_T_base);
}

void draw_finds(WorldSheet& sheet, const RunRecord& record) {
  for (const api::Detection& detection : record.detections) {
    const Pose2 world_T_base = record.truth.world_T_start * detection.map_T_base;
    const double heading_rad = record.truth.world_T_start.theta_rad + detection.bearing_map_rad;
    const double length_m =
        detection.position ? (*detection.position - detection.map_T_base.translation()).norm() : 2.0;
    const Point2 end = world_T_base.translation() + length_m * Point2(std::cos(heading_rad), std::sin(heading_rad));
    sheet.canvas().arrow(sheet.px(world_T_base.translation()), sheet.px(end), {image::look::kTarget, 2.2});
    if (detection.position) {
      const Point2 at = sheet.px(record.truth.world_T_start * *detection.position);
      sheet.canvas().ellipse(at, sheet.px2(detection.position_covariance), 2.0, {image::look::kTarget, 1.5});
    }
  }
  for (const sim::Target& target : record.world.targets) {
    const double depth_m = std::max(target.depth_m, 0.05);
    const std::vector<Point2> corners = rectangle(sheet, target.world_T_target, depth_m, target.width_m);
    sheet.canvas().polygon(corners, {image::kBlack, 2.2});
  }
}

void draw_text(WorldSheet& sheet, const RunRecord& record, const std::string& title) {
  const RunResult& r = record.result;
  std::vector<std::string> facts = {r.outcome + ", " + std::to_string(r.cells_searched) + " cells searched, path " +
                                    fixed(r.path_length_m, 1) + " m, " + fixed(r.robot_time_s, 0) + " s"};
  if (r.first_find) {
    std::string find = "found in cell " + std::to_string(r.first_find->cells_searched) + " at " +
                       fixed(r.first_find->range_m, 1) + " m, bearing error " +
                       fixed(r.first_find->bearing_error_deg, 1) + " deg";
    if (r.last_find && r.last_find->position_error_m) {
      find += "; position error at the end " + fixed(*r.last_find->position_error_m, 2) + " m";
    }
    facts.push_back(std::move(find));
  }
  sheet.head(title, facts);
  sheet.foot({{"true path", image::look::kTrajectory},
              {"searched cell, in order", image::look::kSearched},
              {"unsearched", image::look::kUnsearched},
              {"find: ray, 2 sigma", {image::look::kTarget, 2.2}},
              {"true target", {image::kBlack, 2.2}}});
}

}  // namespace

Image draw_in_world(const RunRecord& record, const std::string& title) {
  WorldSheet sheet(record.world, kLayout);
  draw_world(sheet, record.world);
  draw_lists(sheet, record);
  draw_path(sheet, record);
  draw_finds(sheet, record);
  draw_text(sheet, record, title);
  return sheet.canvas().image();
}

}  // namespace seeker::lab
