#include <cmath>

#include "common/core/angle.hpp"
#include "common/image/map_layers.hpp"
#include "server/lab/run_picture.hpp"
#include "server/lab/table.hpp"

namespace seeker::lab {
namespace {

constexpr int kLargestSide_px = 960;
constexpr double kMargin_m = 0.25;
constexpr int kHeader_px = 88;
constexpr int kFooter_px = 58;
constexpr image::Colour kFurniture{196, 190, 180};

/// The world on a canvas: metres of the frame `world` below a header of text.
struct Sheet {
  image::Canvas canvas;
  image::MapView view;

  [[nodiscard]] Point2 px(const Point2& p_world) const { return view.to_px(p_world) + Point2(0.0, kHeader_px); }
};

Sheet make_sheet(const sim::World& world) {
  image::MapView view;
  view.low = world.min_corner - Point2::Constant(kMargin_m);
  view.high = world.max_corner + Point2::Constant(kMargin_m);
  const Point2 side = view.high - view.low;
  view.px_per_m = kLargestSide_px / side.maxCoeff();
  view.width_px = static_cast<int>(std::ceil(side.x() * view.px_per_m));
  view.height_px = static_cast<int>(std::ceil(side.y() * view.px_per_m));
  return {image::Canvas(view.width_px, view.height_px + kHeader_px + kFooter_px, image::kWhite), view};
}

std::vector<Point2> rectangle(const Sheet& sheet, const Pose2& world_T_box, double length_m, double width_m) {
  std::vector<Point2> corners;
  for (const auto& [sx, sy] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}) {
    corners.push_back(sheet.px(world_T_box * Point2(sx * length_m, sy * width_m)));
  }
  return corners;
}

void draw_world(Sheet& sheet, const sim::World& world) {
  for (const sim::Box& box : world.boxes) {
    const std::vector<Point2> corners = rectangle(sheet, box.world_T_box, box.length_m, box.width_m);
    sheet.canvas.fill_polygon(corners, kFurniture);
    sheet.canvas.polygon(corners, {image::kGrey, 1.0});
  }
  for (const sim::Cylinder& cylinder : world.cylinders) {
    const double radius_px = cylinder.radius_m * sheet.view.px_per_m;
    sheet.canvas.fill_circle(sheet.px(cylinder.centre), radius_px, kFurniture);
    sheet.canvas.circle(sheet.px(cylinder.centre), radius_px, {image::kGrey, 1.0});
  }
  for (const sim::Wall& wall : world.walls) {
    const double width_px = std::max(3.0, wall.thickness_m * sheet.view.px_per_m);
    sheet.canvas.line(sheet.px(wall.a), sheet.px(wall.b), {image::look::kWall, width_px});
  }
}

void draw_lists(Sheet& sheet, const RunRecord& record) {
  if (!record.grid) {
    return;
  }
  const api::GridLists& lists = record.grid->lists;
  const Pose2& world_T_map = record.truth.world_T_start;
  const double side_px = lists.cell_size_m * sheet.view.px_per_m;
  for (const Point2& p_map : lists.unsearched) {
    image::draw_cell(sheet.canvas, sheet.px(world_T_map * p_map), side_px, image::look::kUnsearched, false);
  }
  for (const Point2& p_map : lists.unreachable) {
    image::draw_cell(sheet.canvas, sheet.px(world_T_map * p_map), side_px, image::look::kUnreachable, true);
  }
  int number = 0;
  for (const Point2& p_map : lists.searched) {
    const Point2 at = sheet.px(world_T_map * p_map);
    image::draw_cell(sheet.canvas, at, side_px, image::look::kSearched, false);
    sheet.canvas.text(at + Point2(-side_px / 2.0 + 4.0, -side_px / 2.0 + 13.0), std::to_string(++number),
                      {.colour = image::look::kSearched.colour, .size_px = 9.0, .halo = image::kWhite});
  }
}

void draw_path(Sheet& sheet, const RunRecord& record) {
  std::vector<Point2> path;
  path.reserve(record.true_path.size());
  for (const Pose2& pose : record.true_path) {
    path.push_back(sheet.px(pose.translation()));
  }
  sheet.canvas.polyline(path, image::look::kTrajectory);
  const auto robot = [&](const Pose2& pose) {
    const Point2 at = sheet.px(pose.translation());
    const double radius_px = record.robot_radius_m * sheet.view.px_per_m;
    sheet.canvas.fill_circle(at, radius_px, image::look::kRobot, 0.25);
    sheet.canvas.circle(at, radius_px, {image::look::kRobot, 1.5});
    const Point2 nose = sheet.px(pose * Point2(record.robot_radius_m, 0.0));
    sheet.canvas.line(at, nose, {image::look::kRobot, 2.0});
  };
  robot(record.truth.world_T_start);
  robot(record.truth.world_T_base);
}

void draw_finds(Sheet& sheet, const RunRecord& record) {
  for (const api::Detection& detection : record.detections) {
    const Pose2 world_T_base = record.truth.world_T_start * detection.map_T_base;
    const double heading_rad = record.truth.world_T_start.theta_rad + detection.bearing_map_rad;
    const double length_m =
        detection.position ? (*detection.position - detection.map_T_base.translation()).norm() : 2.0;
    const Point2 end = world_T_base.translation() + length_m * Point2(std::cos(heading_rad), std::sin(heading_rad));
    sheet.canvas.arrow(sheet.px(world_T_base.translation()), sheet.px(end), {image::look::kTarget, 2.2});
    if (detection.position) {
      const Point2 at = sheet.px(record.truth.world_T_start * *detection.position);
      sheet.canvas.ellipse(at, sheet.view.to_px2(detection.position_covariance), 2.0, {image::look::kTarget, 1.5});
    }
  }
  for (const sim::Target& target : record.world.targets) {
    const double depth_m = std::max(target.depth_m, 0.05);
    const std::vector<Point2> corners = rectangle(sheet, target.world_T_target, depth_m, target.width_m);
    sheet.canvas.polygon(corners, {image::kBlack, 2.2});
  }
}

void draw_text(Sheet& sheet, const RunRecord& record, const std::string& title) {
  const RunResult& r = record.result;
  constexpr double kTitle_px = 14.0;
  constexpr double kText_px = 10.5;
  sheet.canvas.text({16.0, 26.0}, title, {.size_px = kTitle_px});
  std::string facts = r.outcome + ", " + std::to_string(r.cells_searched) + " cells searched, path " +
                      fixed(r.path_length_m, 1) + " m, " + fixed(r.robot_time_s, 0) + " s";
  sheet.canvas.text({16.0, 50.0}, facts, {.size_px = kText_px});
  if (r.first_find) {
    std::string find = "found in cell " + std::to_string(r.first_find->cells_searched) + " at " +
                       fixed(r.first_find->range_m, 1) + " m, bearing error " +
                       fixed(r.first_find->bearing_error_deg, 1) + " deg";
    if (r.last_find && r.last_find->position_error_m) {
      find += "; position error at the end " + fixed(*r.last_find->position_error_m, 2) + " m";
    }
    sheet.canvas.text({16.0, 72.0}, find, {.size_px = kText_px});
  }

  const double top = sheet.view.height_px + kHeader_px + 18.0;
  double left = 16.0;
  const auto entry = [&](const std::string& label, const image::Stroke& stroke) {
    sheet.canvas.line({left, top}, {left + 26.0, top}, stroke);
    sheet.canvas.text({left + 32.0, top + 5.0}, label, {.size_px = kText_px});
    left += 32.0 + image::text_width_px(label, kText_px) + 22.0;
  };
  entry("true path", image::look::kTrajectory);
  entry("searched cell, in order", image::look::kSearched);
  entry("unsearched", image::look::kUnsearched);
  entry("find: ray, 2 sigma", {image::look::kTarget, 2.2});
  entry("true target", {image::kBlack, 2.2});
  const double bar_px = sheet.view.px_per_m;
  const Point2 bar(16.0, top + 26.0);
  sheet.canvas.line(bar, bar + Point2(bar_px, 0.0), {image::kBlack, 3.0});
  sheet.canvas.text(bar + Point2(bar_px + 8.0, 5.0), "1 m", {.size_px = kText_px});
}

}  // namespace

Image draw_in_world(const RunRecord& record, const std::string& title) {
  Sheet sheet = make_sheet(record.world);
  draw_world(sheet, record.world);
  draw_lists(sheet, record);
  draw_path(sheet, record);
  draw_finds(sheet, record);
  draw_text(sheet, record, title);
  return sheet.canvas.image();
}

}  // namespace seeker::lab
