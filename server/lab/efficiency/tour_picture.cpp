#include <algorithm>
#include <cmath>

#include "common/image/canvas.hpp"
#include "common/image/map_layers.hpp"
#include "common/image/map_view.hpp"
#include "server/lab/efficiency/tour_command.hpp"

namespace seeker::lab {
namespace {

constexpr int kLargestSide_px = 1400;
constexpr int kHeader_px = 64;
constexpr int kFooter_px = 40;
constexpr double kTitle_px = 12.0;
constexpr double kView_px = 4.0;
constexpr image::Colour kWallColour{60, 60, 60};
constexpr image::Colour kDriveColour{232, 238, 244};
constexpr image::Stroke kOpenTour{image::kBlue, 1.6};
constexpr image::Stroke kWithReturn{image::kOrange, 1.2, image::LineStyle::kDashed};

image::MapView view_of(const Grid<std::uint8_t>& grid) {
  image::MapView view;
  view.low = grid.frame().origin;
  view.high = view.low + grid.frame().resolution_m * Point2(grid.width(), grid.height());
  const Point2 side = view.high - view.low;
  view.px_per_m = kLargestSide_px / side.maxCoeff();
  view.width_px = static_cast<int>(std::ceil(side.x() * view.px_per_m));
  view.height_px = static_cast<int>(std::ceil(side.y() * view.px_per_m));
  return view;
}

void draw_building(image::Canvas& canvas, const image::MapView& view, const tour::KnownBuilding& building) {
  canvas.picture(0, kHeader_px, view.width_px, view.height_px, [&](int u, int v) -> std::optional<image::Colour> {
    const CellIndex cell = building.drive.frame().cell_of(view.to_map({u + 0.5, v + 0.5}));
    if (!building.drive.contains(cell)) {
      return std::nullopt;
    }
    if (building.blocks[cell] != 0) {
      return kWallColour;
    }
    return building.drive[cell] != 0 ? std::optional(kDriveColour) : std::nullopt;
  });
}

}  // namespace

Image draw_tour(const MeasuredTour& measured, const std::string& title) {
  const image::MapView view = view_of(measured.building.drive);
  image::Canvas canvas(view.width_px, view.height_px + kHeader_px + kFooter_px, image::kWhite);
  draw_building(canvas, view, measured.building);
  const auto px = [&](const Point2& p) -> Point2 { return view.to_px(p) + Point2(0.0, kHeader_px); };
  const auto draw = [&](const std::vector<Point2>& path, const image::Stroke& stroke) {
    std::vector<Point2> line(path.size());
    std::transform(path.begin(), path.end(), line.begin(), px);
    canvas.polyline(line, stroke);
  };
  draw(measured.tour.with_return, kWithReturn);
  draw(measured.tour.open_tour, kOpenTour);
  for (const Point2& place : measured.tour.coverage.views) {
    canvas.fill_circle(px(place), kView_px, image::kRed);
  }
  canvas.circle(px(measured.start), 2.0 * kView_px, {image::kBlack, 1.5});
  canvas.text({12.0, 24.0}, title, {.size_px = kTitle_px});
  canvas.text({12.0, 46.0}, "red: viewpoints; blue: one way; dashed: with return; circle: start", {.size_px = 10.0});
  image::draw_scale_bar(canvas, view);
  return canvas.image();
}

}  // namespace seeker::lab
