#include "common/image/segment_export.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "common/image/canvas.hpp"
#include "common/image/export_mark.hpp"

namespace seeker::image {
namespace {

constexpr double kLargestSide_px = 1000.0;
constexpr double kMargin_px = 60.0;
constexpr double kEndRadius_px = 3.0;

struct Extent {
  Point2 low = Point2::Constant(std::numeric_limits<double>::infinity());
  Point2 high = Point2::Constant(-std::numeric_limits<double>::infinity());

  void add(const Point2& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
};

/// From the frame `map` (y up) to the picture (y down).
struct View {
  Point2 low;
  double height_px = 0.0;
  double px_per_m = 1.0;

  [[nodiscard]] Point2 operator()(const Point2& p_map) const {
    const Point2 p = (p_map - low) * px_per_m;
    return {kMargin_px + p.x(), height_px - kMargin_px - p.y()};
  }
};

std::string number(double value, const char* format = "%.4f") {
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

/// 1, 2 or 5 times a power of ten, at most `longest_m`.
double bar_length_m(double longest_m) {
  const double decade = std::pow(10.0, std::floor(std::log10(longest_m)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * decade <= longest_m) {
      return factor * decade;
    }
  }
  return decade;
}

void draw_scale_bar(Canvas& canvas, const View& view) {
  constexpr double kLongest_px = 220.0;
  constexpr double kText_px = 9.0;
  const double length_m = bar_length_m(kLongest_px / view.px_per_m);
  const Point2 left(kMargin_px, view.height_px - kMargin_px / 3.0);
  const Point2 right = left + Point2(length_m * view.px_per_m, 0.0);
  canvas.line(left, right, {kBlack, 3.0});
  canvas.text(right + Point2(kText_px, kText_px / 2.0), number(length_m, "%g") + " m", {kBlack, kText_px});
}

void draw_end(Canvas& canvas, const Point2& at, bool real) {
  canvas.fill_circle(at, kEndRadius_px, real ? kBlue : kWhite);
  canvas.circle(at, kEndRadius_px, {kBlue, 1.0});
}

double sigma(double variance) { return std::sqrt(std::max(0.0, variance)); }

}  // namespace

Result<std::string> segments_svg(const SegmentScene& scene) {
  Extent extent;
  for (const MapSegment& segment : scene.segments) {
    extent.add(segment.left());
    extent.add(segment.right());
  }
  for (const Pose2& pose : scene.trajectory) {
    extent.add(pose.translation());
  }
  if (!extent.low.allFinite() || !extent.high.allFinite()) {
    return fail(Errc::kNotReady, "there are no segments yet: nothing to draw; let the robot sense or move first");
  }
  constexpr double kSmallest_m = 1.0;
  const Point2 size_m = (extent.high - extent.low).cwiseMax(kSmallest_m);
  View view;
  view.low = extent.low;
  view.px_per_m = kLargestSide_px / size_m.maxCoeff();
  view.height_px = size_m.y() * view.px_per_m + 2.0 * kMargin_px;
  Canvas canvas = Canvas::vector(static_cast<int>(std::ceil(size_m.x() * view.px_per_m + 2.0 * kMargin_px)),
                                 static_cast<int>(std::ceil(view.height_px)), kWhite);
  std::vector<Point2> way;
  for (const Pose2& pose : scene.trajectory) {
    way.push_back(view(pose.translation()));
  }
  if (way.size() > 1) {
    canvas.polyline(way, {kOrange, 1.5, LineStyle::kDashed});
  }
  for (const MapSegment& segment : scene.segments) {
    canvas.line(view(segment.left()), view(segment.right()), {kBlack, 2.0});
    draw_end(canvas, view(segment.left()), segment.left_real);
    draw_end(canvas, view(segment.right()), segment.right_real);
  }
  draw_scale_bar(canvas, view);
  canvas.text({kMargin_px, kMargin_px / 2.0}, scene.title, {kBlack, 11.0});
  const Result<std::string> svg = canvas.svg();
  return svg ? Result<std::string>(with_xml_mark(*svg, kMapExport)) : svg;
}

std::string segments_geojson(const std::vector<MapSegment>& segments) {
  std::string text = "{\"type\":\"FeatureCollection\"," + json_mark(kMapExport) +
                     ",\"coordinate_frame\":\"map, local metres\",\"features\":[";
  const char* separator = "\n";
  for (const MapSegment& segment : segments) {
    const auto point = [](const Point2& p) { return "[" + number(p.x()) + "," + number(p.y()) + "]"; };
    const auto flag = [](bool value) { return std::string(value ? "true" : "false"); };
    text += separator;
    text += "{\"type\":\"Feature\",\"id\":" + std::to_string(segment.id) +
            ",\"geometry\":{\"type\":\"LineString\",\"coordinates\":[" + point(segment.left()) + "," +
            point(segment.right()) + "]},\"properties\":{\"id\":" + std::to_string(segment.id) +
            ",\"length_m\":" + number(segment.length_m) + ",\"hits\":" + std::to_string(segment.hits) +
            ",\"sigma_m\":" + number(sigma(segment.covariance(0, 0)), "%.5f") +
            ",\"sigma_rad\":" + number(sigma(segment.covariance(1, 1)), "%.6f") +
            ",\"left_real\":" + flag(segment.left_real) + ",\"right_real\":" + flag(segment.right_real) + "}}";
    separator = ",\n";
  }
  return text + "\n]}\n";
}

}  // namespace seeker::image
