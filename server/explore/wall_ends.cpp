#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/polygon.hpp"
#include "server/explore/openings.hpp"

namespace seeker::explore {
namespace {

using nav::CellState;

/// So near to another wall a wall has met it.
constexpr double kMeet_m = 0.12;
/// So far across its line cells of a wall may lie.
constexpr double kWallBand_m = 0.1;
/// Where to stand: distances from where the wall would go on.
constexpr std::array<double, 4> kViewDistances_m{1.2, 1.8, 2.5, 0.7};

struct WallEnd {
  Point2 p_map;
  Point2 outward_map;  ///< along the wall, away from it
  Point2 into_map;     ///< unit vector from free space into the wall
};

WallEnd end_of(const MapSegment& segment, bool left) {
  const double theta = segment.map_T_segment.theta_rad;
  const Point2 along(std::cos(theta), std::sin(theta));
  return {left ? segment.left() : segment.right(), left ? Point2(-along) : along, Point2(-along.y(), along.x())};
}

/// Sides of other walls that an object within `reach_m` of p may touch.
std::vector<MappedSide> sides_near(const std::vector<MapSegment>& segments, const MapSegment& self,
                                   std::span<const MappedSide> others_sides, const Point2& p_map, double reach_m) {
  std::vector<MappedSide> near;
  const auto add = [&](const MappedSide& side) {
    if (distance_to_segment_m(side.left_map, side.right_map, p_map) < reach_m + kMeet_m) {
      near.push_back(side);
    }
  };
  for (const MapSegment& other : segments) {
    // Most are so far away that their ends need not be known.
    const double middle_m = (other.map_T_segment.translation() - p_map).norm();
    if (other.id != self.id && middle_m < 0.5 * other.length_m + reach_m + kMeet_m) {
      add({other.left(), other.right()});
    }
  }
  std::for_each(others_sides.begin(), others_sides.end(), add);
  return near;
}

/// Where the line of a wall is examined: occupied cells beside it mean that the wall is there.
CellState state_across(const nav::CostMap& map, const Point2& p_map, const Point2& across) {
  const double step_m = map.frame().resolution_m;
  for (double off = -kWallBand_m; off <= kWallBand_m + step_m / 2.0; off += step_m) {
    if (map.state(map.frame().cell_of(p_map + off * across)) == CellState::kOccupied) {
      return CellState::kOccupied;
    }
  }
  return map.state(map.frame().cell_of(p_map));
}

}  // namespace

double possible_extension_m(const nav::CostMap& map, const std::vector<MapSegment>& segments, const MapSegment& segment,
                            bool left, double max_m, std::span<const MappedSide> others_sides) {
  const WallEnd end = end_of(segment, left);
  const std::vector<MappedSide> near = sides_near(segments, segment, others_sides, end.p_map, max_m);
  const double step_m = map.frame().resolution_m;
  double extension_m = 0.0;
  for (double s = step_m; s <= max_m; s += step_m) {
    const Point2 p = end.p_map + s * end.outward_map;
    const bool met = std::any_of(near.begin(), near.end(), [&](const MappedSide& side) {
      return distance_to_segment_m(side.left_map, side.right_map, p) < kMeet_m;
    });
    if (met || state_across(map, p, end.into_map) == CellState::kFree) {
      break;
    }
    extension_m = s;
  }
  return extension_m;
}

std::vector<Opening> wall_end_openings(const OpeningsInput& input, const ViewpointParams& params) {
  std::vector<Opening> openings;
  for (const MapSegment& segment : input.segments) {
    for (const bool left : {true, false}) {
      if (left ? segment.left_real : segment.right_real) {
        continue;
      }
      const WallEnd end = end_of(segment, left);
      Opening opening;
      opening.kind = OpeningKind::kWallEnd;
      opening.p_map = end.p_map;
      opening.outward_map = end.outward_map;
      opening.segment = segment.id;
      opening.size_m = possible_extension_m(input.floor.cost, input.segments, segment, left, params.max_extension_m,
                                            input.others_sides);
      const Point2 extension = end.p_map + params.min_extension_m * end.outward_map;
      if (opening.size_m >= params.min_extension_m && input.areas.allows(extension) &&
          find_viewpoint(opening, {extension, end.into_map, kViewDistances_m}, input, params)) {
        openings.push_back(opening);
      }
    }
  }
  return openings;
}

}  // namespace seeker::explore
