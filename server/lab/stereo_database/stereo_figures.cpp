#include <cmath>

#include "common/core/angle.hpp"
#include "common/image/plot.hpp"
#include "server/lab/experiments/table.hpp"
#include "server/lab/stereo_database/reproduce_stereo_database.hpp"

namespace seeker::lab {
namespace {

constexpr int kPlanSide_px = 900;
constexpr double kMillimetres = 1000.0;

std::vector<std::string> row_of(const StereoResult& run, const DatabaseScore& score) {
  return {run.mode,
          std::to_string(run.seed),
          score.name,
          std::to_string(score.landmarks),
          fixed(kMillimetres * score.rms_x_m, 1),
          fixed(kMillimetres * score.rms_y_m, 1),
          fixed(kMillimetres * score.rms_m, 1),
          fixed(rad_to_deg(score.rms_rad), 3),
          fixed(score.mean_nees, 2),
          fixed(score.mean_inliers, 1),
          fixed(score.median_step_ms, 2),
          std::to_string(score.not_localised),
          std::to_string(score.unnoticed),
          std::to_string(score.frames)};
}

double value_of(const ErrorSample& sample, const std::string& what) {
  if (what == "x") {
    return kMillimetres * sample.x_m;
  }
  if (what == "y") {
    return kMillimetres * sample.y_m;
  }
  return what == "angle" ? rad_to_deg(sample.theta_rad) : kMillimetres * std::hypot(sample.x_m, sample.y_m);
}

}  // namespace

std::string table3_csv(const std::vector<StereoResult>& runs) {
  Table table({"mode", "seed", "database", "landmarks", "rms_x_mm", "rms_y_mm", "rms_mm", "rms_deg", "mean_nees",
               "mean_inliers", "median_step_ms", "not_localised", "unnoticed", "frames"});
  for (const StereoResult& run : runs) {
    for (const DatabaseScore& score : run.scores) {
      table.add(row_of(run, score));
    }
  }
  return table.csv();
}

Image plan_figure(const DatabasePlan& plan, const std::vector<Point2>& path) {
  image::Chart chart;
  chart.title = "Database '" + plan.name + "', " + std::to_string(plan.landmarks.size()) + " landmarks";
  chart.x_label = "x, m";
  chart.y_label = "y, m";
  chart.equal_scale = true;
  image::Series landmarks{.name = "landmarks", .x = {}, .y = {}, .style = image::SeriesStyle::kPoints};
  for (const Point2& p : plan.landmarks) {
    landmarks.x.push_back(p.x());
    landmarks.y.push_back(p.y());
  }
  image::Series robot{.name = "robot", .x = {}, .y = {}, .style = image::SeriesStyle::kLine};
  for (const Point2& p : path) {
    robot.x.push_back(p.x());
    robot.y.push_back(p.y());
  }
  robot.colour = image::kRed;
  chart.series = {std::move(landmarks), std::move(robot)};
  return image::draw_chart(chart, kPlanSide_px, kPlanSide_px);
}

Image error_figure(const std::vector<ErrorCurve>& curves, const std::string& what) {
  image::Chart chart;
  chart.title = "Error in " + what;
  chart.x_label = "time, s";
  chart.y_label = what == "angle" ? "error, deg" : "error, mm";
  for (const ErrorCurve& curve : curves) {
    image::Series series{.name = curve.name, .x = {}, .y = {}, .style = image::SeriesStyle::kLine};
    for (const ErrorSample& sample : curve.samples) {
      series.x.push_back(sample.time_s);
      series.y.push_back(value_of(sample, what));
    }
    chart.series.push_back(std::move(series));
  }
  return image::draw_chart(chart);
}

}  // namespace seeker::lab
