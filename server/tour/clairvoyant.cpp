#include "server/tour/clairvoyant.hpp"

#include <string>
#include <utility>

#include "common/core/text.hpp"
#include "server/tour/floor_paths.hpp"
#include "server/tour/route.hpp"

namespace seeker::tour {
namespace {

RouteCosts costs_between(const KnownBuilding& building, const Point2& start, const std::vector<Point2>& views) {
  RouteCosts costs;
  const auto count = static_cast<Eigen::Index>(views.size());
  costs.between = Eigen::MatrixXd::Zero(count, count);
  const FloorPaths from_start(building.drive, start);
  for (Eigen::Index a = 0; a < count; ++a) {
    const Point2& from = views[static_cast<std::size_t>(a)];
    costs.from_start.push_back(from_start.length_m(from));
    const FloorPaths paths(building.drive, from);
    for (Eigen::Index b = a + 1; b < count; ++b) {
      costs.between(a, b) = paths.length_m(views[static_cast<std::size_t>(b)]);
      costs.between(b, a) = costs.between(a, b);
    }
  }
  return costs;
}

std::vector<Point2> path_over(const Grid<std::uint8_t>& drive, const std::vector<Point2>& stops) {
  std::vector<Point2> path{stops.front()};
  for (std::size_t k = 1; k < stops.size(); ++k) {
    const std::vector<Point2> leg = FloorPaths(drive, stops[k - 1], &stops[k]).path_to(stops[k]);
    path.insert(path.end(), leg.begin(), leg.end());
  }
  return path;
}

std::vector<Point2> stops_of(const Route& route, const Point2& start, const std::vector<Point2>& views) {
  std::vector<Point2> stops{start};
  for (const std::size_t view : route) {
    stops.push_back(views[view]);
  }
  return stops;
}

}  // namespace

Result<ClairvoyantTour> clairvoyant_tour(const KnownBuilding& building, const Point2& start,
                                         const CoverageParams& params) {
  const CellIndex cell = building.drive.frame().cell_of(start);
  if (!building.drive.contains(cell) || building.drive[cell] == 0) {
    return fail(Errc::kUnreachable, "the start " + text(start) + " is not on floor that the robot can drive on");
  }
  Result<Coverage> coverage = cover(building, {start}, params);
  if (!coverage) {
    return tl::unexpected(coverage.error());
  }
  ClairvoyantTour tour;
  tour.coverage = std::move(*coverage);
  RouteCosts costs = costs_between(building, start, tour.coverage.views);
  const Route open_tour = short_route(costs);
  tour.open_tour_m = route_cost(costs, open_tour);
  tour.open_tour = path_over(building.drive, stops_of(open_tour, start, tour.coverage.views));
  costs.to_end = costs.from_start;
  const Route with_return = short_route(costs);
  tour.with_return_m = route_cost(costs, with_return);
  std::vector<Point2> stops = stops_of(with_return, start, tour.coverage.views);
  stops.push_back(start);
  tour.with_return = path_over(building.drive, stops);
  return tour;
}

}  // namespace seeker::tour
