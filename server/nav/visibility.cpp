#include "server/nav/visibility.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/angle.hpp"
#include "common/core/occupancy_tile.hpp"
#include "server/nav/ray.hpp"

namespace seeker::nav {
namespace {

/// Bytes at or above `threshold` hide; an unknown cell hides or not as asked.
class Hides {
 public:
  explicit Hides(const VisibilityParams& params)
      : threshold_(static_cast<int>(std::ceil(params.occupied_probability * kOccupiedCell))),
        unknown_(params.unknown_blocks) {}
  [[nodiscard]] bool operator()(std::uint8_t cell) const {
    return cell == kUnknownCell ? unknown_ : static_cast<int>(cell) >= threshold_;
  }

 private:
  int threshold_;
  bool unknown_;
};

Point2 in_cells(const GridFrame& frame, const Point2& p_map) { return (p_map - frame.origin) / frame.resolution_m; }

bool sees(const Grid<std::uint8_t>& occupancy, const Point2& a_cells, const Point2& b_cells, const Hides& hides) {
  RayWalk walk(a_cells, b_cells);
  while (walk.advance() && walk.steps_left() > 0) {
    if (hides(occupancy[walk.cell()])) {
      return false;
    }
  }
  return true;
}

bool inside(const Grid<std::uint8_t>& grid, const Point2& p_map) {
  return p_map.allFinite() && grid.contains(grid.frame().cell_of(p_map));
}

}  // namespace

bool line_of_sight(const Grid<std::uint8_t>& occupancy, const Point2& a_map, const Point2& b_map,
                   const VisibilityParams& params) {
  if (!inside(occupancy, a_map) || !inside(occupancy, b_map)) {
    return false;
  }
  const GridFrame& frame = occupancy.frame();
  return sees(occupancy, in_cells(frame, a_map), in_cells(frame, b_map), Hides(params));
}

std::vector<CellIndex> visible_cells_of(const Grid<std::uint8_t>& wanted, const Grid<std::uint8_t>& occupancy,
                                        const Point2& from_map, double range_m, const VisibilityParams& params) {
  std::vector<CellIndex> seen;
  if (wanted.empty() || !inside(occupancy, from_map) || range_m <= 0.0) {
    return seen;
  }
  const Hides hides(params);
  const Point2 from = in_cells(occupancy.frame(), from_map);
  const int reach = static_cast<int>(std::ceil(range_m / wanted.frame().resolution_m));
  const CellIndex centre = wanted.frame().cell_of(from_map);
  for (int j = std::max(0, centre.j - reach); j <= std::min(wanted.height() - 1, centre.j + reach); ++j) {
    for (int i = std::max(0, centre.i - reach); i <= std::min(wanted.width() - 1, centre.i + reach); ++i) {
      const CellIndex cell{i, j};
      const Point2 p_map = wanted.frame().centre_of(cell);
      if (wanted[cell] != 0 && (p_map - from_map).norm() <= range_m && inside(occupancy, p_map) &&
          sees(occupancy, from, in_cells(occupancy.frame(), p_map), hides)) {
        seen.push_back(cell);
      }
    }
  }
  return seen;
}

}  // namespace seeker::nav
