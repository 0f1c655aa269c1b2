#include "server/app/fleet/own_map.hpp"

#include <utility>

namespace seeker::app {

nav::SharedFloor floor_of(const std::vector<OccupancyTile>& tiles) {
  std::optional<Grid<std::uint8_t>> floor = assemble(tiles);
  return floor ? std::make_shared<const Grid<std::uint8_t>>(*std::move(floor)) : nullptr;
}

SharedSearch shared_search(std::vector<SearchedFloor> searched, const SharedSearch& before) {
  if (searched.empty() || (before && *before == searched)) {
    return searched.empty() ? nullptr : before;
  }
  return std::make_shared<const std::vector<SearchedFloor>>(std::move(searched));
}

SharedSides shared_sides(std::vector<MappedSide> sides, const SharedSides& before) {
  if (sides.empty() || (before && *before == sides)) {
    return sides.empty() ? nullptr : before;
  }
  return std::make_shared<const std::vector<MappedSide>>(std::move(sides));
}

}  // namespace seeker::app
