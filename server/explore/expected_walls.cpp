#include "server/explore/expected_walls.hpp"

namespace seeker::explore {
namespace {

/// Floor beside the end of a wall counts as free although the wall goes on: so far beyond it free cells prove nothing.
constexpr double kUnsure_m = 0.15;

}  // namespace

Grid<std::uint8_t> expected_walls(const nav::CostMap& map, const std::vector<MapSegment>& segments, double longest_m) {
  const GridFrame& frame = map.frame();
  Grid<std::uint8_t> walls(frame, map.width(), map.height(), 0);
  const double cell_m = frame.resolution_m;
  const double step_m = cell_m / 2.0;  // no cell is left out
  for (const MapSegment& segment : segments) {
    const double half_m = 0.5 * segment.length_m;
    const Point2 middle = segment.map_T_segment.translation();
    const Point2 along = segment.map_T_segment * Point2::UnitX() - middle;
    const Point2 across(-along.y(), along.x());
    const auto mark = [&](double x_m) {
      for (const double off_m : {-cell_m, 0.0, cell_m}) {  // so thick that no ray slips through
        const CellIndex cell = frame.cell_of(middle + x_m * along + off_m * across);
        if (walls.contains(cell)) {
          walls[cell] = 1;
        }
      }
    };
    for (double x = -half_m; x <= half_m; x += step_m) {
      mark(x);
    }
    for (const bool left : {true, false}) {
      const double expected_m = (left ? segment.left_real : segment.right_real) ? 0.0 : longest_m;
      for (double s = step_m; s <= expected_m; s += step_m) {
        const double x = left ? -half_m - s : half_m + s;
        if (s > kUnsure_m && map.state(frame.cell_of(middle + x * along)) == nav::CellState::kFree) {
          break;
        }
        mark(x);
      }
    }
  }
  return walls;
}

}  // namespace seeker::explore
