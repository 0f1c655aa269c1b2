#include "server/lab/efficiency/tour_command.hpp"

#include <string>

#include "common/config/yaml.hpp"
#include "common/image/png.hpp"
#include "server/lab/efficiency/known_building.hpp"
#include "server/lab/experiments/described_json.hpp"
#include "server/lab/experiments/table.hpp"
#include "server/options/world_options.hpp"

namespace seeker::lab {

/// What is printed of a tour.
struct TourFigures {
  std::string building;
  double floor_m2 = 0.0;
  double wall_m = 0.0;
  std::size_t views = 0;
  double floor_share = 0.0;
  double wall_share = 0.0;
  double open_tour_m = 0.0;
  double with_return_m = 0.0;
};

// Not in an unnamed namespace: argument-dependent look-up would not find it from Fields.
void describe(config::Fields& f, TourFigures& figures) {
  std::uint64_t views = figures.views;
  f.field("building", figures.building);
  f.field("floor_m2", figures.floor_m2);
  f.field("wall_m", figures.wall_m);
  f.field("views", views);
  f.field("floor_share", figures.floor_share);
  f.field("wall_share", figures.wall_share);
  f.field("open_tour_m", figures.open_tour_m);
  f.field("with_return_m", figures.with_return_m);
}

namespace {

TourFigures figures_of(const TourOptions& o, const MeasuredTour& measured) {
  const tour::ClairvoyantTour& tour = measured.tour;
  return {o.building.stem().string(), tour.coverage.floor_m2,   tour.coverage.wall_m, tour.coverage.views.size(),
          tour.coverage.floor_share,  tour.coverage.wall_share, tour.open_tour_m,     tour.with_return_m};
}

std::string text_of(const TourFigures& figures) {
  constexpr double kPercent = 100.0;
  return figures.building + ": " + std::to_string(figures.views) + " viewpoints see " +
         fixed(kPercent * figures.floor_share, 1) + " % of " + fixed(figures.floor_m2, 0) + " m\xC2\xB2 of floor and " +
         fixed(kPercent * figures.wall_share, 1) + " % of " + fixed(figures.wall_m, 0) + " m of walls; one way " +
         fixed(figures.open_tour_m, 1) + " m, with return " + fixed(figures.with_return_m, 1) + " m\n";
}

/// A map of map_server names its picture, a world has walls.
bool is_ros_map(const std::filesystem::path& file) {
  const Result<std::string> text = config::read_text_file(file);
  return text && text->find("image:") != std::string::npos && text->find("resolution:") != std::string::npos;
}

Result<MeasuredTour> building_and_start(const TourOptions& o) {
  MeasuredTour measured;
  if (is_ros_map(o.building)) {
    const Result<RosMap> map = read_ros_map(o.building);
    if (!map) {
      return tl::unexpected<Error>(map.error());
    }
    measured.start = o.start.value_or(Point2::Zero());
    Result<tour::KnownBuilding> building = building_of(*map, measured.start, o.robot_radius_m);
    if (!building) {
      return tl::unexpected<Error>(building.error());
    }
    measured.building = std::move(*building);
    return measured;
  }
  Result<sim::World> world = options::load_world(o.building);
  if (!world) {
    return tl::unexpected<Error>(world.error());
  }
  if (o.start) {
    world->starts = {{o.start->x(), o.start->y(), 0.0}};
    if (const Status valid = sim::validate(*world); !valid) {
      return tl::unexpected<Error>(valid.error());
    }
  }
  measured.start = world->starts.front().translation();
  measured.building = building_of(*world, o.robot_radius_m, o.scanner_height_m);
  return measured;
}

}  // namespace

Result<MeasuredTour> measure_tour(const TourOptions& o) {
  Result<MeasuredTour> measured = building_and_start(o);
  if (!measured) {
    return measured;
  }
  Result<tour::ClairvoyantTour> tour = tour::clairvoyant_tour(measured->building, measured->start, o.coverage);
  if (!tour) {
    return fail_with_context(o.building.string(), tour.error());
  }
  measured->tour = std::move(*tour);
  return measured;
}

Status run_tour(const TourOptions& o, std::ostream& out) {
  const Result<MeasuredTour> measured = measure_tour(o);
  if (!measured) {
    return tl::unexpected<Error>(measured.error());
  }
  TourFigures figures = figures_of(o, *measured);
  if (!o.picture.empty()) {
    std::string title = text_of(figures);
    title.pop_back();
    if (const Status drawn = image::write_png(o.picture, draw_tour(*measured, title)); !drawn) {
      return drawn;
    }
  }
  out << (o.json ? to_json(figures) : text_of(figures));
  return {};
}

}  // namespace seeker::lab
