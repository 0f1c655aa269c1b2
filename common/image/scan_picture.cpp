#include "common/image/scan_picture.hpp"

#include <functional>

#include "common/image/canvas.hpp"
#include "common/image/map_layers.hpp"
#include "common/image/map_view.hpp"

namespace seeker::image {
namespace {

constexpr double kLegendText_px = 10.0;
constexpr double kLegendRow_px = 20.0;
constexpr double kLegendPad_px = 14.0;
constexpr double kReturn_px = 2.0;
constexpr double kLineEnd_px = 3.5;
constexpr double kSensor_px = 6.0;
constexpr double kSensorArrow_m = 0.5;

Stroke stroke_of_line(std::size_t index) { return {series_colour(index), 2.0, LineStyle::kSolid, 0.9}; }

/// The strip below the scan: what the grey points and the coloured lines are.
void draw_scan_legend(Canvas& canvas, const MapView& view, const ScanScene& scene) {
  const double height_px = canvas.height_px() - view.height_px;
  canvas.fill_rect({0.0, static_cast<double>(view.height_px), static_cast<double>(view.width_px), height_px}, kWhite);
  const Point2 first(kLegendPad_px, view.height_px + kLegendRow_px);
  const Point2 second = first + Point2(0.0, kLegendRow_px);
  const Point2 middle(0.5 * kLegendPad_px, -0.4 * kLegendText_px);
  canvas.fill_circle(first + middle, kReturn_px, kGrey);
  canvas.text(first + Point2(2.0 * kLegendPad_px, 0.0), scene.title, {kBlack, kLegendText_px});
  canvas.line(second + Point2(0.0, middle.y()), second + Point2(kLegendPad_px, middle.y()), stroke_of_line(0));
  canvas.text(second + Point2(2.0 * kLegendPad_px, 0.0),
              std::to_string(scene.lines.size()) + (scene.lines.size() == 1 ? " line" : " lines"),
              {kBlack, kLegendText_px});
}

Result<MapView> view_of(const ScanScene& scene) {
  if (scene.points.empty()) {
    return fail(Errc::kNotReady, "the scan has no returns to draw");
  }
  MapScene extent;
  for (const Point2& point : scene.points) {
    extent.trajectory.push_back({point.x(), point.y(), 0.0});
  }
  extent.robot = Pose2{};  // the sensor is in the picture, too
  return fit_view(extent, {});
}

Result<Canvas> draw_on(const ScanScene& scene, const std::function<Canvas(int, int)>& make_canvas) {
  const Result<MapView> view = view_of(scene);
  if (!view) {
    return tl::unexpected<Error>(view.error());
  }
  constexpr double kLegend_px = 2.0 * kLegendRow_px + kLegendPad_px;
  Canvas canvas = make_canvas(view->width_px, view->height_px + static_cast<int>(kLegend_px));
  for (const Point2& point : scene.points) {
    canvas.fill_circle(view->to_px(point), kReturn_px, kGrey);
  }
  for (std::size_t k = 0; k < scene.lines.size(); ++k) {
    const Stroke stroke = stroke_of_line(k);
    const Point2 start = view->to_px(scene.lines[k].first);
    const Point2 end = view->to_px(scene.lines[k].second);
    canvas.line(start, end, stroke);
    canvas.fill_circle(start, kLineEnd_px, stroke.colour);
    canvas.fill_circle(end, kLineEnd_px, stroke.colour);
  }
  canvas.arrow(view->to_px(Point2::Zero()), view->to_px(Point2(kSensorArrow_m, 0.0)), {kBlack, 1.5});
  canvas.circle(view->to_px(Point2::Zero()), kSensor_px, {kBlack, 1.5});
  draw_scale_bar(canvas, *view);
  draw_scan_legend(canvas, *view, scene);
  return canvas;
}

}  // namespace

Result<Image> draw_scan(const ScanScene& scene) {
  const auto pixels = [](int width_px, int height_px) { return Canvas(width_px, height_px, kWhite); };
  return draw_on(scene, pixels).map([](Canvas&& canvas) { return canvas.image(); });
}

Result<std::string> scan_svg(const ScanScene& scene) {
  const auto shapes = [](int width_px, int height_px) { return Canvas::vector(width_px, height_px, kWhite); };
  return draw_on(scene, shapes).map([](Canvas&& canvas) { return canvas.svg(); });
}

}  // namespace seeker::image
