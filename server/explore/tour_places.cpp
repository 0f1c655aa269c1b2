#include "server/explore/tour_places.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "server/explore/expected_walls.hpp"
#include "server/explore/view_gain.hpp"

namespace seeker::explore {
namespace {

/// Distances from which a border is looked at, the farthest first: from there most of what lies behind is in view.
constexpr std::array<double, 4> kBorderViews_m{3.0, 2.25, 1.5, 0.9};

/// The cheapest place from which a border is in view, if it is cheaper to reach than the border itself.
std::optional<Opening> seen_from(const Opening& opening, const OpeningsInput& input, const ViewpointParams& params) {
  if (opening.kind != OpeningKind::kFrontier || opening.visits > 0) {
    return std::nullopt;
  }
  Opening from_afar = opening;
  from_afar.cost = 0.0;  // set by the first viewpoint that is found
  const SideView side{opening.p_map, opening.outward_map, kBorderViews_m};
  const bool found = find_viewpoint(from_afar, side, input, params) && from_afar.cost < opening.cost;
  return found ? std::optional(from_afar) : std::nullopt;
}

bool same_place(const TourPlace& place, const Opening& opening, std::uint16_t room, double together_m) {
  return place.room == room && (place.opening.p_map - opening.p_map).norm() <= together_m;
}

}  // namespace

tour::Rooms rooms_of(const nav::FloorView& floor, const tour::RoomsParams& params) {
  Grid<float> clearance_m(floor.reachable.frame(), floor.reachable.width(), floor.reachable.height(), 0.0F);
  for (std::size_t k = 0; k < clearance_m.cells().size(); ++k) {
    if (floor.reachable.cells()[k] != 0) {
      const Point2 centre = clearance_m.frame().centre_of(clearance_m.cell(k));
      clearance_m.cells()[k] = floor.cost.clearance_m(floor.cost.frame().cell_of(centre));
    }
  }
  return tour::Rooms::find(floor.reachable, clearance_m, params);
}

TourPlaces tour_places(const PlaceInput& input, const tour::Rooms& rooms, const ExploreParams& params) {
  const StrategyInput& robot = input.robot;
  const OpeningsInput scene{input.floor,          input.costs,      robot.segments,
                            robot.floors.areas(), robot.map_T_base, robot.now};
  const Grid<std::uint8_t> walls =
      expected_walls(input.floor.cost, robot.segments, params.tour.expected_wall_m, robot.others_sides());
  TourPlaces places;
  for (const Opening& found : input.openings) {
    const bool border = found.kind == OpeningKind::kFrontier;
    const std::uint16_t room = rooms.at(found.p_map);
    const double gain_m2 =
        border ? view_gain(input.floor.cost, found.p_map, params.one_step.sensor, &walls).area_m2 : 0.0;
    const bool worth_it = gain_m2 > params.viewpoints.min_gain_m2;
    std::vector<TourPlace>& list = worth_it ? places.worth_it : places.passing;
    const auto beside = std::find_if(list.begin(), list.end(), [&](const TourPlace& place) {
      return worth_it && same_place(place, found, room, params.tour.together_m);
    });
    if (beside != list.end()) {
      beside->ids.push_back(found.id);
      beside->gain_m2 += gain_m2;
    } else if (list.size() < static_cast<std::size_t>(params.tour.max_places)) {
      const std::optional<Opening> view = worth_it ? seen_from(found, scene, params.viewpoints) : std::nullopt;
      list.push_back({found, view.value_or(found).map_T_view.translation(), {found.id}, gain_m2, room});
    }
  }
  return places;
}

}  // namespace seeker::explore
