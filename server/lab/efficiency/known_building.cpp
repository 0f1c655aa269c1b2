#include "server/lab/efficiency/known_building.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/text.hpp"
#include "server/nav/distance_transform.hpp"
#include "server/nav/flood.hpp"
#include "server/nav/ray.hpp"
#include "server/sim/placement.hpp"
#include "server/sim/scene.hpp"

namespace seeker::lab {
namespace {

void mark(Grid<std::uint8_t>& grid, CellIndex cell) {
  if (grid.contains(cell)) {
    grid[cell] = 1;
  }
}

void mark_line(Grid<std::uint8_t>& grid, const Point2& a, const Point2& b) {
  const GridFrame& frame = grid.frame();
  nav::RayWalk walk((a - frame.origin) / frame.resolution_m, (b - frame.origin) / frame.resolution_m);
  do {
    mark(grid, walk.cell());
  } while (walk.advance());
}

Grid<std::uint8_t> like(const Grid<std::uint8_t>& grid) { return {grid.frame(), grid.width(), grid.height(), 0}; }

/// Cells that are joined to `start` by cells that are not 0.
Grid<std::uint8_t> joined_to(const Grid<std::uint8_t>& cells, CellIndex start) {
  Grid<std::uint8_t> joined = like(cells);
  joined[start] = 1;
  nav::flood(start, [&](CellIndex next) {
    const bool is_new = cells.contains(next) && cells[next] != 0 && joined[next] == 0;
    if (is_new) {
      joined[next] = 1;
    }
    return is_new;
  });
  return joined;
}

}  // namespace

tour::KnownBuilding building_of(const sim::World& world, double robot_radius_m, double height_m) {
  const Grid<float> floor = sim::reachable_floor(world, robot_radius_m, kBuildingCell_m);
  tour::KnownBuilding building;
  building.drive = Grid<std::uint8_t>(floor.frame(), floor.width(), floor.height(), 0);
  std::transform(floor.cells().begin(), floor.cells().end(), building.drive.cells().begin(),
                 [](float clearance) { return static_cast<std::uint8_t>(clearance >= 0.0F ? 1 : 0); });
  building.blocks = like(building.drive);
  const sim::Scene scene(world);
  for (const sim::Face& face : scene.faces()) {
    if (face.z_min_m <= height_m && face.z_max_m >= height_m) {
      mark_line(building.blocks, face.segment.a, face.segment.b());
    }
  }
  building.free = like(building.drive);
  std::transform(building.blocks.cells().begin(), building.blocks.cells().end(), building.free.cells().begin(),
                 [](std::uint8_t blocks) { return static_cast<std::uint8_t>(blocks == 0 ? 1 : 0); });
  return building;
}

Result<tour::KnownBuilding> building_of(const RosMap& map, const Point2& start, double robot_radius_m) {
  tour::KnownBuilding building{map.occupied, like(map.occupied), like(map.occupied)};
  const Grid<float> wall_cells = nav::distance_transform(map.occupied);
  Grid<std::uint8_t> room = like(map.occupied);
  for (std::size_t k = 0; k < room.cells().size(); ++k) {
    const bool free = map.known.cells()[k] != 0 && map.occupied.cells()[k] == 0;
    const double clearance_m = map.occupied.frame().resolution_m * static_cast<double>(wall_cells.cells()[k]);
    building.free.cells()[k] = free ? 1 : 0;
    room.cells()[k] = free && clearance_m >= robot_radius_m ? 1 : 0;
  }
  const CellIndex cell = room.frame().cell_of(start);
  if (!room.contains(cell) || room[cell] == 0) {
    return fail(Errc::kUnreachable, "a robot of this radius cannot stand at " + text(start) +
                                        " on the map; name another start with --start X,Y");
  }
  building.drive = joined_to(room, cell);
  return building;
}

}  // namespace seeker::lab
