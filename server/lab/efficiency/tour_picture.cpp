#include <optional>

#include "server/lab/efficiency/tour_command.hpp"
#include "server/lab/plots/world_sheet.hpp"

namespace seeker::lab {
namespace {

constexpr WorldSheet::Layout kLayout{.margin_m = 0.0};
constexpr double kView_px = 4.0;
constexpr image::Colour kWallColour{60, 60, 60};
constexpr image::Colour kDriveColour{232, 238, 244};
constexpr image::Stroke kOpenTour{image::kBlue, 1.6};
constexpr image::Stroke kWithReturn{image::kOrange, 1.2, image::LineStyle::kDashed};

WorldSheet sheet_of(const GridFrame& frame, int width, int height) {
  return {frame.origin, frame.origin + frame.resolution_m * Point2(width, height), kLayout};
}

void paint_building(WorldSheet& sheet, const tour::KnownBuilding& building) {
  sheet.paint([&](const Point2& p) -> std::optional<image::Colour> {
    const CellIndex cell = building.drive.frame().cell_of(p);
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
  const Grid<std::uint8_t>& drive = measured.building.drive;
  WorldSheet sheet = sheet_of(drive.frame(), drive.width(), drive.height());
  paint_building(sheet, measured.building);
  sheet.polyline(measured.tour.with_return, kWithReturn);
  sheet.polyline(measured.tour.open_tour, kOpenTour);
  for (const Point2& place : measured.tour.coverage.views) {
    sheet.canvas().fill_circle(sheet.px(place), kView_px, image::kRed);
  }
  sheet.canvas().circle(sheet.px(measured.start), 2.0 * kView_px, {image::kBlack, 1.5});
  sheet.head(title, {"red: viewpoints; circle: start"});
  sheet.foot({{"one way", kOpenTour}, {"with return", kWithReturn}});
  return sheet.canvas().image();
}

}  // namespace seeker::lab
