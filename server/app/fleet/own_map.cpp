#include "server/app/fleet/own_map.hpp"

namespace seeker::app {

nav::SharedFloor floor_of(const std::vector<OccupancyTile>& tiles) {
  std::optional<Grid<std::uint8_t>> floor = assemble(tiles);
  return floor ? std::make_shared<const Grid<std::uint8_t>>(*std::move(floor)) : nullptr;
}

}  // namespace seeker::app
