#include "server/explore/expected_walls.hpp"

#include <utility>

namespace seeker::explore {
namespace {

/// Floor beside the end of a wall counts as free although the wall goes on: so far beyond it free cells prove nothing.
constexpr double kUnsure_m = 0.15;

/// Marks walls in the cells of a map.
class WallMarks {
 public:
  WallMarks(const nav::CostMap& map, double longest_m)
      : map_(map), longest_m_(longest_m), walls_(map.frame(), map.width(), map.height(), 0) {}

  /// The wall between two points, and what is expected of it beyond the ends that are not `real`.
  void add(const Point2& left_map, bool left_real, const Point2& right_map, bool right_real) {
    const double length_m = (right_map - left_map).norm();
    if (length_m <= 0.0) {
      return;
    }
    const Point2 along = (right_map - left_map) / length_m;
    for (double x = 0.0; x <= length_m; x += step_m()) {
      mark(left_map + x * along, along);
    }
    if (!left_real) {
      go_on(left_map, -along);
    }
    if (!right_real) {
      go_on(right_map, along);
    }
  }
  [[nodiscard]] Grid<std::uint8_t> take() && { return std::move(walls_); }

 private:
  [[nodiscard]] double step_m() const { return map_.frame().resolution_m / 2.0; }  // no cell is left out

  void mark(const Point2& p_map, const Point2& along) {
    const double cell_m = map_.frame().resolution_m;
    const Point2 across(-along.y(), along.x());
    for (const double off_m : {-cell_m, 0.0, cell_m}) {  // so thick that no ray slips through
      const CellIndex cell = map_.frame().cell_of(p_map + off_m * across);
      if (walls_.contains(cell)) {
        walls_[cell] = 1;
      }
    }
  }

  void go_on(const Point2& end_map, const Point2& outward) {
    for (double s = step_m(); s <= longest_m_; s += step_m()) {
      const Point2 p_map = end_map + s * outward;
      if (s > kUnsure_m && map_.state(map_.frame().cell_of(p_map)) == nav::CellState::kFree) {
        return;
      }
      mark(p_map, outward);
    }
  }

  const nav::CostMap& map_;
  double longest_m_;
  Grid<std::uint8_t> walls_;
};

}  // namespace

Grid<std::uint8_t> expected_walls(const nav::CostMap& map, const std::vector<MapSegment>& segments, double longest_m,
                                  std::span<const MappedSide> others_sides) {
  WallMarks marks(map, longest_m);
  for (const MapSegment& segment : segments) {
    marks.add(segment.left(), segment.left_real, segment.right(), segment.right_real);
  }
  for (const MappedSide& side : others_sides) {
    marks.add(side.left_map, false, side.right_map, false);
  }
  return std::move(marks).take();
}

}  // namespace seeker::explore
