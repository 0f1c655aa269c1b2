#include "server/nav/surroundings.hpp"

#include <cmath>

#include "common/core/angle.hpp"
#include "common/core/occupancy_tile.hpp"

namespace seeker::nav {
namespace {

constexpr int kSeenDirections = 72;

bool seen_towards(const OccupancyMap& map, const Point2& p_map, const Point2& ahead, double from_m, double to_m) {
  for (double along_m = from_m; along_m <= to_m; along_m += kTileResolution_m) {
    if (map.probability_at(p_map + along_m * ahead)) {
      return true;
    }
  }
  return false;
}

}  // namespace

double unseen_share(const OccupancyMap& map, const Point2& p_map, double from_m, double to_m) {
  int unseen = 0;
  for (int k = 0; k < kSeenDirections; ++k) {
    const double angle_rad = kTwoPi * k / kSeenDirections;
    const Point2 ahead(std::cos(angle_rad), std::sin(angle_rad));
    unseen += seen_towards(map, p_map, ahead, from_m, to_m) ? 0 : 1;
  }
  return static_cast<double>(unseen) / kSeenDirections;
}

}  // namespace seeker::nav
