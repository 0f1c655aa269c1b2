#include "server/explore/trap_watch.hpp"

#include <algorithm>

namespace seeker::explore {

MapSize size_of(const std::vector<MapSegment>& segments, const nav::FloorView* floor) {
  MapSize size;
  size.segments = segments.size();
  for (const MapSegment& segment : segments) {
    size.walls_m += segment.length_m;
  }
  if (floor != nullptr) {
    const auto& cells = floor->cost.states().cells();
    const double cell_m = floor->cost.frame().resolution_m;
    size.floor_m2 =
        cell_m * cell_m * static_cast<double>(std::count(cells.begin(), cells.end(), nav::CellState::kFree));
  }
  return size;
}

bool TrapWatch::note(bool gains_nothing, const MapSize& size) {
  const bool grew = size.walls_m > largest_.walls_m + params_.least_growth_m ||
                    size.floor_m2 > largest_.floor_m2 + params_.least_growth_m2;
  if (grew) {
    largest_.walls_m = std::max(largest_.walls_m, size.walls_m);
    largest_.floor_m2 = std::max(largest_.floor_m2, size.floor_m2);
  }
  hopeless_ = gains_nothing ? hopeless_ + 1 : 0;
  fruitless_ = grew ? 0 : fruitless_ + 1;
  return hopeless_ >= params_.trap_decisions || fruitless_ >= params_.fruitless_decisions;
}

void TrapWatch::reset(bool suspicious) {
  hopeless_ = suspicious ? params_.trap_decisions - 1 : 0;
  fruitless_ = 0;
}

}  // namespace seeker::explore
