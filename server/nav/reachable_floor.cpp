#include <cmath>
#include <vector>

#include "server/nav/departure_cell.hpp"
#include "server/nav/planner.hpp"

namespace seeker::nav {
namespace {

/// Grid of `resolution_m` that covers `fine`, its borders on multiples of the resolution.
Grid<std::uint16_t> covering_grid(const CostMap& map, double resolution_m) {
  const Point2 low = map.frame().origin;
  const Point2 high = low + map.frame().resolution_m * Point2(map.width(), map.height());
  const Point2 origin = resolution_m * (low / resolution_m).array().floor().matrix();
  const Point2 size = ((high - origin) / resolution_m).array().ceil().matrix();
  return {GridFrame{origin, resolution_m}, static_cast<int>(size.x()), static_cast<int>(size.y()), 0};
}

}  // namespace

Result<Grid<std::uint8_t>> reachable_floor(const CostMap& map, const Point2& start_map, double resolution_m,
                                           const PlannerParams& params) {
  if (!(resolution_m >= map.frame().resolution_m)) {
    return fail(Errc::kInvalidArgument, "the floor's resolution must not be finer than that of the occupancy");
  }
  const auto start = departure_cell(map, start_map, params.start_snap_m);
  if (!start) {
    return fail(Errc::kUnreachable, "the robot is walled in: no free floor near where it stands; move it away");
  }
  Grid<std::uint16_t> counts = covering_grid(map, resolution_m);
  for (const CellIndex& cell : connected_cells(map, *start)) {
    const CellIndex coarse = counts.frame().cell_of(map.frame().centre_of(cell));
    counts[coarse] = static_cast<std::uint16_t>(counts[coarse] + 1);
  }
  const double fine_per_coarse = std::pow(resolution_m / map.frame().resolution_m, 2);
  Grid<std::uint8_t> floor(counts.frame(), counts.width(), counts.height(), 0);
  for (std::size_t k = 0; k < counts.cells().size(); ++k) {
    floor.cells()[k] = static_cast<double>(counts.cells()[k]) >= fine_per_coarse / 2.0 ? 1 : 0;
  }
  return floor;
}

}  // namespace seeker::nav
