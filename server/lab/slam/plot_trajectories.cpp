#include "server/lab/slam/plot_trajectories.hpp"

#include <algorithm>

#include "common/image/canvas.hpp"
#include "common/image/map_layers.hpp"
#include "common/image/map_view.hpp"
#include "common/image/png.hpp"
#include "common/image/scan_picture.hpp"
#include "server/app/composition/robot_options.hpp"
#include "server/lab/experiments/table.hpp"
#include "server/lab/scoring/score_reference.hpp"
#include "server/lab/slam/robot_of_log.hpp"
#include "server/lab/slam/slam_run.hpp"
#include "server/nav/occupancy_map.hpp"

namespace seeker::lab {
namespace {

constexpr double kText_px = 10.0;
constexpr double kRow_px = 20.0;
constexpr double kPad_px = 14.0;
constexpr double kSample_px = 26.0;

/// One row of the legend.
struct Row {
  std::string label;
  image::Stroke stroke;
};

image::Stroke stroke_of(std::size_t index) { return {image::series_colour(index), 2.0, image::LineStyle::kSolid, 0.9}; }

double legend_height_px(const std::vector<Row>& rows) { return kRow_px * static_cast<double>(rows.size()) + kPad_px; }

/// An empty picture: the view, and a strip for the legend below it.
image::Canvas new_canvas(const image::MapView& view, const std::vector<Row>& rows) {
  return {view.width_px, view.height_px + static_cast<int>(legend_height_px(rows)), image::kWhite};
}

void draw_legend(image::Canvas& canvas, const image::MapView& view, const std::vector<Row>& rows) {
  canvas.fill_rect(
      {0.0, static_cast<double>(view.height_px), static_cast<double>(view.width_px), legend_height_px(rows)},
      image::kWhite);
  Point2 at(kPad_px, view.height_px + kRow_px);
  for (const Row& row : rows) {
    canvas.line(at - Point2(0.0, 0.4 * kText_px), at + Point2(kSample_px, -0.4 * kText_px), row.stroke);
    canvas.text(at + Point2(kSample_px + kPad_px, 0.0), row.label, {image::kBlack, kText_px});
    at.y() += kRow_px;
  }
}

Result<std::vector<NamedTrajectory>> read_all(const PlotOptions& o) {
  std::vector<NamedTrajectory> all;
  for (const std::filesystem::path& path : o.trajectories) {
    Result<TrajectoryFile> file = read_trajectory(path);
    if (!file) {
      return tl::unexpected<Error>(file.error());
    }
    all.push_back({path.filename().string(), std::move(file->poses)});
    if (!o.align || all.size() == 1) {
      continue;
    }
    const Result<ReferenceReport> fit = score_reference(all.back().poses, all.front().poses, 1.0);
    if (!fit) {
      return fail_with_context(path.string(), fit.error());
    }
    for (StampedPose& pose : all.back().poses) {
      pose.map_T_base = fit->reference_T_map * pose.map_T_base;
    }
  }
  return all;
}

Result<std::optional<Grid<std::uint8_t>>> walls_of(const PlotOptions& o, const Trajectory& trajectory) {
  if (o.log.empty()) {
    return std::nullopt;
  }
  const Result<RobotOfLog> robot = robot_of_log(o.robot, o.config, o.log, o.overrides);
  if (!robot) {
    return tl::unexpected<Error>(robot.error());
  }
  nav::OccupancyMap map(robot->options.occupancy);
  const Status walked =
      for_each_scan(o.log, robot->options.replay.params, trajectory,
                    [&map](const LaserScan& scan, const Pose2& pose) { (void)map.integrate(scan, pose); });
  if (!walked) {
    return tl::unexpected<Error>(walked.error());
  }
  return map.snapshot();
}

}  // namespace

Result<Image> draw_trajectories(const std::vector<NamedTrajectory>& trajectories,
                                const std::optional<Grid<std::uint8_t>>& walls) {
  image::MapScene scene;
  scene.occupancy = walls;
  for (const NamedTrajectory& each : trajectories) {
    for (const StampedPose& pose : each.poses) {
      scene.trajectory.push_back(pose.map_T_base);
    }
  }
  const Result<image::MapView> view = image::fit_view(scene, {});
  if (!view) {
    return tl::unexpected<Error>(view.error());
  }
  std::vector<Row> rows;
  for (std::size_t k = 0; k < trajectories.size(); ++k) {
    rows.push_back({trajectories[k].name + ", " + fixed(length_m(trajectories[k].poses), 1) + " m", stroke_of(k)});
  }
  image::Canvas canvas = new_canvas(*view, rows);
  if (walls) {
    image::draw_occupancy(canvas, *view, *walls);
  }
  for (std::size_t k = 0; k < trajectories.size(); ++k) {
    std::vector<Point2> points_px;
    for (const StampedPose& pose : trajectories[k].poses) {
      points_px.push_back(view->to_px(pose.map_T_base.translation()));
    }
    canvas.polyline(points_px, stroke_of(k));
  }
  image::draw_scale_bar(canvas, *view);
  draw_legend(canvas, *view, rows);
  return canvas.image();
}

Result<Image> draw_scan(const LaserScan& scan, const lines::ScanLines& found, const std::string& title) {
  LaserScan in_laser = scan;
  in_laser.base_T_laser = {};
  image::ScanScene scene{.title = title, .points = points_in_base(in_laser), .lines = {}};
  for (const lines::Line& line : found.lines) {
    scene.lines.emplace_back(line.start, line.end);
  }
  return image::draw_scan(scene);
}

Status run_plot(const PlotOptions& options, std::ostream& out) {
  const Result<std::vector<NamedTrajectory>> all = read_all(options);
  if (!all) {
    return tl::unexpected<Error>(all.error());
  }
  const Result<std::optional<Grid<std::uint8_t>>> walls = walls_of(options, all->front().poses);
  if (!walls) {
    return tl::unexpected<Error>(walls.error());
  }
  const Result<Image> picture = draw_trajectories(*all, *walls);
  if (!picture) {
    return tl::unexpected<Error>(picture.error());
  }
  if (const Status ok = image::write_png(options.out, *picture); !ok) {
    return ok;
  }
  out << "wrote " << options.out.string() << '\n';
  return {};
}

}  // namespace seeker::lab
