#include "server/nav/passage.hpp"

#include "server/nav/flood.hpp"

namespace seeker::nav {
namespace {

/// Robots that pass each other keep this much between them.
constexpr double kApart_m = 0.1;

}  // namespace

bool blocks_passage(const CostMap& map, const DistanceField& costs, const Point2& p_map, double min_m2) {
  const GridFrame& frame = map.frame();
  const double apart_m = 2.0 * map.params().robot_radius_m + kApart_m;
  Grid<std::uint8_t> open(frame, map.width(), map.height(), 0);
  for (CellIndex cell{0, 0}; cell.j < open.height(); ++cell.j) {
    for (cell.i = 0; cell.i < open.width(); ++cell.i) {
      open[cell] = costs.cost_to(cell) && (frame.centre_of(cell) - p_map).norm() > apart_m ? 1 : 0;
    }
  }
  const auto enter = [&](CellIndex cell) {
    const bool entered = open.contains(cell) && open[cell] != 0;
    if (entered) {
      open[cell] = 0;
    }
    return entered;
  };
  int parts = 0;
  for (CellIndex seed{0, 0}; seed.j < open.height() && parts < 2; ++seed.j) {
    for (seed.i = 0; seed.i < open.width() && parts < 2; ++seed.i) {
      if (enter(seed)) {
        const auto cells = static_cast<double>(flood(seed, enter).size());
        parts += cells * frame.resolution_m * frame.resolution_m >= min_m2 ? 1 : 0;
      }
    }
  }
  return parts > 1;
}

}  // namespace seeker::nav
