#include "server/lab/plots/world_sheet.hpp"

#include <algorithm>
#include <cmath>

#include "common/image/map_layers.hpp"

namespace seeker::lab {
namespace {

constexpr int kFooter_px = 76;  // the row of the legend, and the scale bar with its label
constexpr double kLeft_px = 16.0;
constexpr double kTitle_px = 14.0;
constexpr double kText_px = 10.5;
constexpr double kFirstLine_px = 24.0;
constexpr double kLineStep_px = 20.0;
constexpr double kSample_px = 26.0;

image::MapView view_of(const Point2& min_corner, const Point2& max_corner, const WorldSheet::Layout& layout) {
  image::MapView view;
  view.low = min_corner - Point2::Constant(layout.margin_m);
  view.high = max_corner + Point2::Constant(layout.margin_m);
  const Point2 side = view.high - view.low;
  view.px_per_m = layout.largest_side_px / side.maxCoeff();
  view.width_px = static_cast<int>(std::ceil(side.x() * view.px_per_m));
  view.height_px = static_cast<int>(std::ceil(side.y() * view.px_per_m));
  return view;
}

}  // namespace

WorldSheet::WorldSheet(const sim::World& world, const Layout& layout)
    : WorldSheet(world.min_corner, world.max_corner, layout) {}

WorldSheet::WorldSheet(const Point2& min_corner, const Point2& max_corner, const Layout& layout)
    : header_px_(layout.header_px),
      view_(view_of(min_corner, max_corner, layout)),
      canvas_(view_.width_px, view_.height_px + header_px_ + kFooter_px, image::kWhite) {}

void WorldSheet::paint(const std::function<std::optional<image::Colour>(const Point2& p_world)>& colour_at) {
  canvas_.picture(0, header_px_, view_.width_px, view_.height_px, [&](int u, int v) {
    return colour_at(view_.to_map({u + 0.5, v + 0.5}));
  });
}

void WorldSheet::polyline(const std::vector<Point2>& path_world, const image::Stroke& stroke) {
  std::vector<Point2> line(path_world.size());
  std::transform(path_world.begin(), path_world.end(), line.begin(), [&](const Point2& p) { return px(p); });
  canvas_.polyline(line, stroke);
}

void WorldSheet::head(const std::string& title, const std::vector<std::string>& facts) {
  Point2 at(kLeft_px, kFirstLine_px);
  canvas_.text(at, title, {.size_px = kTitle_px});
  for (const std::string& fact : facts) {
    at.y() += kLineStep_px;
    canvas_.text(at, fact, {.size_px = kText_px});
  }
}

void WorldSheet::foot(const std::vector<LegendEntry>& legend) {
  constexpr double kGap_px = 22.0;
  const double y = view_.height_px + header_px_ + 0.5 * kLineStep_px;
  double left = kLeft_px;
  for (const LegendEntry& entry : legend) {
    canvas_.line({left, y}, {left + kSample_px, y}, entry.stroke);
    left += kSample_px + 6.0;
    canvas_.text({left, y + 5.0}, entry.label, {.size_px = kText_px});
    left += image::text_width_px(entry.label, kText_px) + kGap_px;
  }
  image::draw_scale_bar(canvas_, view_);
}

}  // namespace seeker::lab
