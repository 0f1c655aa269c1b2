#include <cmath>

#include "common/core/angle.hpp"
#include "common/image/plot.hpp"
#include "server/lab/line_detection/line_scene.hpp"
#include "server/lab/line_detection/reproduce_line_detection.hpp"

namespace seeker::lab {
namespace {

constexpr double kMillimetres = 1000.0;
constexpr int kSide_px = 900;
constexpr int kFitHeight_px = 560;

image::Series points_of(const LaserScan& scan, const lines::ScanLines& found, std::int32_t line) {
  image::Series series{.name = "", .x = {}, .y = {}, .style = image::SeriesStyle::kPoints};
  for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
    if (std::isfinite(scan.ranges_m[beam]) && found.line_of_beam[beam] == line) {
      const double range_mm = kMillimetres * static_cast<double>(scan.ranges_m[beam]);
      series.x.push_back(range_mm * std::cos(scan.angle_rad(beam)));
      series.y.push_back(range_mm * std::sin(scan.angle_rad(beam)));
    }
  }
  return series;
}

}  // namespace

Image table1_figure(const LaserScan& scan, const lines::ScanLines& found) {
  image::Chart chart;
  chart.title = "Scan of Table 1 with its lines";
  chart.x_label = "x, mm";
  chart.y_label = "y, mm";
  chart.equal_scale = true;
  chart.series.push_back(points_of(scan, found, lines::kNoLine));
  for (std::size_t row = 0; row < kTable1.size(); ++row) {
    const std::optional<std::size_t> index = find_row(found, kTable1[row]);
    if (!index) {
      continue;
    }
    const lines::Line& line = found.lines[*index];
    image::Series points = points_of(scan, found, static_cast<std::int32_t>(*index));
    points.colour = image::kGrey;
    chart.series.push_back(points);
    chart.series.push_back({.name = kTable1[row].name,
                            .x = {kMillimetres * line.start.x(), kMillimetres * line.end.x()},
                            .y = {kMillimetres * line.start.y(), kMillimetres * line.end.y()},
                            .colour = image::series_colour(row)});
  }
  image::Series sensor{.name = "sensor", .x = {0.0}, .y = {0.0}, .style = image::SeriesStyle::kPoints};
  sensor.colour = image::kRed;
  chart.series.push_back(sensor);
  return image::draw_chart(chart, kSide_px, kSide_px);
}

Image table1_fit_figure(const LaserScan& scan, const lines::ScanLines& found) {
  image::Chart chart;
  chart.title = "Distances of the points from their lines";
  chart.x_label = "bearing, deg";
  chart.y_label = "distance, mm";
  for (std::size_t row = 0; row < kTable1.size(); ++row) {
    const std::optional<std::size_t> index = find_row(found, kTable1[row]);
    if (!index) {
      continue;
    }
    const lines::Line& line = found.lines[*index];
    image::Series series{.name = kTable1[row].name, .x = {}, .y = {}, .style = image::SeriesStyle::kLineAndPoints};
    for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
      if (found.line_of_beam[beam] == static_cast<std::int32_t>(*index)) {
        const double range_m = static_cast<double>(scan.ranges_m[beam]);
        const double distance_m = range_m * std::cos(scan.angle_rad(beam) - line.alpha_rad) - line.r_m;
        series.x.push_back(rad_to_deg(scan.angle_rad(beam)));
        series.y.push_back(kMillimetres * distance_m);
      }
    }
    series.colour = image::series_colour(row);
    chart.series.push_back(std::move(series));
  }
  return image::draw_chart(chart, kSide_px, kFitHeight_px);
}

}  // namespace seeker::lab
