#include "common/image/map_layers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string>

#include "common/core/angle.hpp"
#include "common/core/occupancy_tile.hpp"

namespace seeker::image {
namespace {

/// Of a cell of occupancy or evidence that something is known of.
double probability(std::uint8_t cell) { return static_cast<double>(cell) / kOccupiedCell; }

/// The most occupied known value of the cells under a pixel: thin walls stay when the map is drawn small.
std::uint8_t value_under(const Grid<std::uint8_t>& grid, const Point2& low, const Point2& high) {
  const CellIndex a = grid.frame().cell_of(low);
  const CellIndex b = grid.frame().cell_of(high);
  int best = -1;
  for (int j = std::max(0, a.j); j <= std::min(b.j, grid.height() - 1); ++j) {
    for (int i = std::max(0, a.i); i <= std::min(b.i, grid.width() - 1); ++i) {
      const std::uint8_t value = grid[{i, j}];
      if (value != kUnknownCell) {
        best = std::max(best, static_cast<int>(value));
      }
    }
  }
  return best < 0 ? kUnknownCell : static_cast<std::uint8_t>(best);
}

/// Lays colours of the known values of a grid over the view.
void draw_grid(Canvas& canvas, const MapView& view, const Grid<std::uint8_t>& grid,
               const std::function<Colour(std::uint8_t)>& colour_of, double alpha) {
  const bool shrinks = grid.frame().resolution_m * view.px_per_m < 1.0;
  const auto colour_at = [&](int u, int v) -> std::optional<Colour> {
    std::uint8_t value = kUnknownCell;
    if (shrinks) {
      const Point2 a = view.to_map(Point2(u, v + 1.0));
      value = value_under(grid, a, view.to_map(Point2(u + 1.0, v)));
    } else {
      const CellIndex c = grid.frame().cell_of(view.to_map(Point2(u + 0.5, v + 0.5)));
      value = grid.contains(c) ? grid[c] : kUnknownCell;
    }
    return value == kUnknownCell ? std::nullopt : std::optional<Colour>(colour_of(value));
  };
  canvas.picture(0, 0, view.width_px, view.height_px, colour_at, alpha);
}

std::vector<Point2> to_px(const MapView& view, const std::vector<Point2>& points) {
  std::vector<Point2> pixels;
  pixels.reserve(points.size());
  std::transform(points.begin(), points.end(), std::back_inserter(pixels),
                 [&](const Point2& p) { return view.to_px(p); });
  return pixels;
}

Point2 on_map(const Canvas& canvas, Point2 at, double width_px, double height_px) {
  at.x() = std::clamp(at.x(), 4.0, std::max(4.0, canvas.width_px() - width_px - 4.0));
  at.y() = std::clamp(at.y(), height_px + 4.0, std::max(height_px + 4.0, canvas.height_px() - 4.0));
  return at;
}

void draw_detection(Canvas& canvas, const MapView& view, const DetectionMark& mark) {
  const Point2 from = view.to_px(mark.seen_from);
  constexpr double kRay_m = 4.0;
  const Point2 ray(std::cos(mark.bearing_map_rad), std::sin(mark.bearing_map_rad));
  const Point2 at = view.to_px(mark.position.value_or(mark.seen_from + kRay_m * ray));
  canvas.line(from, at, {look::kTarget, 1.4, LineStyle::kDashed, 0.8});
  canvas.fill_circle(from, 2.5, look::kTarget);
  constexpr double kSize_px = 13.0;
  if (mark.position) {
    canvas.ellipse(at, view.to_px2(mark.covariance), 2.0, {look::kTarget, 1.6, LineStyle::kSolid, 0.9});
    draw_pin(canvas, at, kSize_px);
  }
  constexpr double kText_px = 10.0;
  const std::string label = mark.position ? mark.name : mark.name + " (bearing only)";
  const Point2 place = on_map(canvas, at + Point2(kSize_px, kText_px / 2.0), text_width_px(label, kText_px), kText_px);
  canvas.text(place, label, {look::kTarget, kText_px, Anchor::kLeft, false, kWhite});
}

}  // namespace

void draw_occupancy(Canvas& canvas, const MapView& view, const Grid<std::uint8_t>& occupancy) {
  const auto colour_of = [](std::uint8_t value) {
    const double p = probability(value);
    // Steepened about 1/2: cells seen once or twice already look free or occupied.
    return mix(look::kFree, look::kWall, std::clamp((p - 0.3) / 0.4, 0.0, 1.0));
  };
  draw_grid(canvas, view, occupancy, colour_of, 1.0);
}

void draw_evidence(Canvas& canvas, const MapView& view, const Grid<std::uint8_t>& evidence) {
  const auto colour_of = [](std::uint8_t value) { return red_to_green(probability(value)); };
  draw_grid(canvas, view, evidence, colour_of, look::kEvidenceAlpha);
}

void draw_areas(Canvas& canvas, const MapView& view, const MapScene& scene) {
  for (const Polygon& area : scene.keep_out) {
    const std::vector<Point2> corners = to_px(view, area);
    canvas.fill_polygon(corners, kRed, 0.14);
    canvas.polygon(corners, look::kKeepOut);
  }
  if (scene.bound) {
    canvas.polygon(to_px(view, *scene.bound), look::kBound);
  }
}

void draw_cell(Canvas& canvas, const Point2& centre_px, double side_px, const Stroke& stroke, bool cross) {
  const double half = side_px / 2.0;
  canvas.rect({centre_px.x() - half, centre_px.y() - half, side_px, side_px}, stroke);
  if (cross) {
    const double arm = 0.45 * half;
    canvas.line(centre_px - Point2(arm, arm), centre_px + Point2(arm, arm), stroke);
    canvas.line(centre_px - Point2(arm, -arm), centre_px + Point2(arm, -arm), stroke);
  }
}

void draw_cells(Canvas& canvas, const MapView& view, const MapScene& scene) {
  constexpr double kGap = 0.92;  // neighbours keep apart
  const double side_px = kGap * scene.cell_size_m * view.px_per_m;
  for (const Point2& centre : scene.searched) {
    draw_cell(canvas, view.to_px(centre), side_px, look::kSearched, false);
  }
  for (const Point2& centre : scene.unsearched) {
    draw_cell(canvas, view.to_px(centre), side_px, look::kUnsearched, false);
  }
  for (const Point2& centre : scene.unreachable) {
    draw_cell(canvas, view.to_px(centre), side_px, look::kUnreachable, true);
  }
}

void draw_paths(Canvas& canvas, const MapView& view, const MapScene& scene) {
  for (const Point2& p : scene.scan) {
    canvas.fill_circle(view.to_px(p), 1.5, kRed, 0.8);
  }
  canvas.polyline(to_px(view, scene.planned_path), look::kPlan);
  std::vector<Point2> track;
  for (const Pose2& pose : scene.trajectory) {
    track.push_back(view.to_px(pose.translation()));
  }
  if (track.empty()) {
    return;
  }
  constexpr double kCasing_px = 2.0;
  canvas.polyline(track, {kWhite, look::kTrajectory.width_px + kCasing_px, LineStyle::kSolid, 0.7});
  canvas.polyline(track, look::kTrajectory);
  canvas.fill_circle(track.front(), 5.0, kWhite);
  canvas.circle(track.front(), 5.0, {look::kTrajectory.colour, 2.2});
  constexpr double kText_px = 8.5;
  canvas.text(track.front() + Point2(8.0, kText_px + 4.0), "start",
              {look::kTrajectory.colour, kText_px, Anchor::kLeft, false, kWhite});
}

void draw_gaps(Canvas& canvas, const MapView& view, const std::vector<GapMark>& gaps) {
  const std::vector<GapMark> listed = listed_gaps(gaps);
  for (std::size_t n = 0; n < std::min(listed.size(), kNumberedGaps); ++n) {
    const Point2 at = view.to_px(listed[n].centre);
    constexpr double kRadius_px = 8.5;
    constexpr double kText_px = 8.0;
    canvas.fill_circle(at, kRadius_px, kWhite, 0.9);
    canvas.circle(at, kRadius_px, {look::kGap, 1.6});
    canvas.text(at + Point2(0.0, kText_px / 2.0), std::to_string(n + 1), {look::kGap, kText_px, Anchor::kCentre});
  }
}

void draw_pin(Canvas& canvas, const Point2& at_px, double size_px) {
  constexpr int kCorners = 10;
  std::array<Point2, kCorners> star;
  for (int i = 0; i < kCorners; ++i) {
    const double radius = i % 2 == 0 ? size_px * 0.72 : size_px * 0.31;
    const double angle = -kPi / 2.0 + kTwoPi * i / kCorners;
    star.at(static_cast<std::size_t>(i)) = at_px + radius * Point2(std::cos(angle), std::sin(angle));
  }
  canvas.polygon(star, {kWhite, 4.0});
  canvas.fill_polygon(star, look::kTarget);
}

void draw_detections(Canvas& canvas, const MapView& view, const std::vector<DetectionMark>& detections) {
  for (const DetectionMark& mark : detections) {
    draw_detection(canvas, view, mark);
  }
}

void draw_robot(Canvas& canvas, const MapView& view, const Pose2& map_T_base, double radius_m) {
  constexpr double kSmallest_px = 7.0;
  const Point2 at = view.to_px(map_T_base.translation());
  const double radius = std::max(kSmallest_px, radius_m * view.px_per_m);
  const Point2 nose = at + 0.82 * radius * Point2(std::cos(map_T_base.theta_rad), -std::sin(map_T_base.theta_rad));
  const Point2 side = 0.55 * (nose - at);
  const Point2 across(-side.y(), side.x());
  canvas.fill_circle(at, radius, look::kRobot, 0.88);
  canvas.circle(at, radius, {kWhite, 1.5});
  canvas.fill_polygon(std::array<Point2, 4>{nose, at - side + across, at - 0.4 * side, at - side - across}, kWhite);
}

void draw_scale_bar(Canvas& canvas, const MapView& view) {
  constexpr std::array<double, 12> kLengths_m{0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000};
  constexpr double kShare = 0.25;
  double length_m = kLengths_m.front();
  for (const double candidate : kLengths_m) {
    if (candidate * view.px_per_m <= kShare * view.width_px) {
      length_m = candidate;
    }
  }
  const double length_px = length_m * view.px_per_m;
  const Point2 a(16.0, canvas.height_px() - 16.0);
  canvas.fill_rect({a.x() - 8.0, a.y() - 27.0, length_px + 16.0, 35.0}, kWhite, 0.8);
  for (int half = 0; half < 2; ++half) {
    canvas.fill_rect({a.x() + half * length_px / 2.0, a.y() - 5.0, length_px / 2.0, 5.0}, half == 0 ? kBlack : kWhite);
  }
  canvas.rect({a.x(), a.y() - 5.0, length_px, 5.0}, {kBlack, 1.2});
  std::string label = length_m < 1.0 ? "0.5 m" : std::to_string(static_cast<int>(length_m)) + " m";
  canvas.text(a + Point2(length_px / 2.0, -10.0), label, {kBlack, 9.5, Anchor::kCentre});
}

}  // namespace seeker::image
