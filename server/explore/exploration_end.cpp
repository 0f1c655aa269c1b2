#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/text.hpp"
#include "server/explore/exploration_impl.hpp"
#include "server/explore/openings.hpp"
#include "server/nav/frontiers.hpp"
#include "server/nav/lookout.hpp"
#include "server/nav/passage.hpp"

namespace seeker::explore {
namespace {

/// Places within this distance of each other are reported once.
constexpr double kSamePlace_m = 1.0;
constexpr std::size_t kMaxUnreachable = 64;
/// Of the openings that were not worth a drive so many are named.
constexpr std::size_t kMaxNamed = 5;
/// How deep unknown floor is taken to be behind a metre of its border, for the progress.
constexpr double kDepthBehindBorder_m = 2.0;
constexpr double kProgressPeriod_s = 3.0;
/// So far beyond the border of the unknown lies what it leads to.
constexpr double kBeyond_m = 0.3;

/// Of two at the same place the larger one says how much is left.
void add_places(const std::vector<UnreachablePlace>& from, std::vector<UnreachablePlace>& to) {
  for (const UnreachablePlace& place : from) {
    const auto same = std::find_if(to.begin(), to.end(), [&](const UnreachablePlace& other) {
      return (other.p_map - place.p_map).norm() <= kSamePlace_m;
    });
    if (same != to.end()) {
      same->size_m = std::max(same->size_m, place.size_m);
    } else if (to.size() < kMaxUnreachable) {
      to.push_back(place);
    }
  }
}

/// Places whose size is not known are as wide as the longest border of unknown floor about them.
void measure(const std::vector<nav::Frontier>& borders, const GridFrame& frame, std::vector<UnreachablePlace>& places) {
  for (UnreachablePlace& place : places) {
    if (place.size_m > 0.0) {
      continue;
    }
    for (const nav::Frontier& border : borders) {
      const bool here = std::any_of(border.cells.begin(), border.cells.end(), [&](CellIndex cell) {
        return (frame.centre_of(cell) - place.p_map).norm() <= kSamePlace_m;
      });
      place.size_m = here ? std::max(place.size_m, border.length_m) : place.size_m;
    }
  }
}

/// The floor as if nothing was forbidden.
struct Unlimited {
  nav::CostMap cost;
  nav::DistanceField costs;
};

/// Nothing where nothing is forbidden, either.
std::optional<Unlimited> without_limits(const nav::FloorView& floor, const nav::ForbiddenAreas& areas,
                                        const Point2& robot_map, const nav::CostMapParams& params) {
  if (areas.empty()) {
    return std::nullopt;
  }
  auto cost = nav::CostMap::build(floor.occupancy, params);
  if (!cost) {
    return std::nullopt;
  }
  auto costs = nav::DistanceField::build(*cost, robot_map);
  return costs ? std::optional(Unlimited{std::move(*cost), std::move(*costs)}) : std::nullopt;
}

/// Whether unknown floor would be left if nothing was forbidden: then the limits are why the exploration ends.
bool more_beyond_limits(const Unlimited& unlimited, const nav::FloorView& floor, const nav::ForbiddenAreas& areas,
                        const Point2& robot_map, const ViewpointParams& params) {
  const nav::ForbiddenAreas nothing;
  const std::vector<MapSegment> no_walls;
  const nav::FloorView open_floor{floor.occupancy, unlimited.cost, floor.reachable, floor.revision, floor.built};
  const std::vector<Opening> openings = frontier_openings(
      {open_floor, unlimited.costs, no_walls, nothing, {robot_map.x(), robot_map.y(), 0.0}, floor.built}, params);
  return std::any_of(openings.begin(), openings.end(), [&](const Opening& opening) {
    return !areas.allows(opening.p_map) || !areas.allows(opening.p_map + kBeyond_m * opening.outward_map);
  });
}

std::string list_of(const std::vector<Point2>& places) {
  std::string list;
  for (const Point2& p : places) {
    list += (list.empty() ? "" : ", ") + text(p);
  }
  return list;
}

/// Names the first few of the openings that were not worth a drive.
std::string what_remains(const std::vector<Point2>& left_map) {
  if (left_map.empty()) {
    return "nothing is left to explore";
  }
  const auto named = static_cast<std::ptrdiff_t>(std::min(left_map.size(), kMaxNamed));
  return "nothing is left to explore but what is too little to drive to, " + std::to_string(left_map.size()) +
         (left_map.size() == 1 ? " place" : " places") + ": " + list_of({left_map.begin(), left_map.begin() + named}) +
         (left_map.size() > kMaxNamed ? " and others" : "");
}

ExploreEnd unreachable_end(std::vector<UnreachablePlace> places, const std::vector<Point2>& somebody_at) {
  const std::string who = somebody_at.empty() ? "" : "; a person or an object blocks the path at ";
  return {EndKind::kUnreachable, "no path leads to what is left: " + describe(places) + who + list_of(somebody_at),
          "open doors or clear the path, then explore again; or give a bound without these places", std::move(places)};
}

}  // namespace

/// Whether a path led to enough of the floor before: then somebody blocks it now.
bool Exploration::Impl::was_reachable(const CutOffFloor& part, const GridFrame& frame) const {
  const auto cells = std::count_if(part.cells.begin(), part.cells.end(),
                                   [&](CellIndex cell) { return known_floor_.was_reachable(frame.centre_of(cell)); });
  return frame.resolution_m * frame.resolution_m * static_cast<double>(cells) >= params_.viewpoints.min_cut_off_m2;
}

Exploration::Impl::Left Exploration::Impl::what_is_left(const StrategyInput& input) {
  Left left;
  const auto floor = floors_.view(true);
  const Point2 here = input.map_T_base.translation();
  if (!floor) {
    left.no_floor = floor.error();
    return left;
  }
  const auto costs = nav::DistanceField::build((*floor)->cost, here);
  if (!costs) {
    left.no_floor = costs.error();
    return left;
  }
  const auto& reachable = (*floor)->reachable.cells();
  if (std::all_of(reachable.begin(), reachable.end(), [](std::uint8_t cell) { return cell == 0; })) {
    left.no_floor = Error{Errc::kUnreachable, "the robot is walled in: there is no floor around it to drive on"};
    return left;
  }
  const auto unlimited = without_limits(**floor, request_.areas, here, params_.cost);
  for (const CutOffFloor& part : cut_off_floor((*floor)->cost, *costs, params_.viewpoints.min_cut_off_m2)) {
    if (unlimited && unlimited->costs.cost_to(part.p_map)) {
      left.beyond_limits = true;  // the path there is forbidden, not blocked
    } else if (nav::seen_by_itself(**floor, part.p_map)) {
      // What only other robots have seen is theirs to look after.
      left.cut_off.push_back({part.p_map, was_reachable(part, (*floor)->cost.frame())});
      left.cut_off_places.push_back(unreachable_place(part));
    }
  }
  left.frame = (*floor)->cost.frame();
  left.borders = nav::find_frontiers((*floor)->cost, *costs, 0.0);
  left.people = blocked_paths({**floor, *costs, input.segments, request_.areas, input.map_T_base, input.now},
                              known_floor_, floors_.obstacles_map(), params_.viewpoints);
  left.beyond_limits = left.beyond_limits ||
                       (unlimited && more_beyond_limits(*unlimited, **floor, request_.areas, here, params_.viewpoints));
  return left;
}

ExploreEnd Exploration::Impl::end_for(const Left& left, const StrategyStep& last, const Point2& here_map) const {
  if (left.no_floor) {
    return {EndKind::kUnreachable,
            left.no_floor->message,
            "set the robot on free floor inside the bound, then explore",
            {{here_map, request_.areas.cause_of_no_floor(here_map), 0.0, ""}}};
  }
  std::vector<UnreachablePlace> unreachable;
  std::vector<UnreachablePlace> given_up = last.unreachable;
  measure(left.borders, left.frame, given_up);
  add_places(given_up, unreachable);
  add_places(left.cut_off_places, unreachable);
  add_places(left.people.behind_map, unreachable);
  if (!unreachable.empty()) {
    return unreachable_end(std::move(unreachable), left.people.at_map);
  }
  const std::string known = text(known_floor_.present_area_m2()) + " m\xC2\xB2 of floor are known";
  if (left.beyond_limits) {
    return {EndKind::kBoundReached,
            known + "; all that is left lies beyond the bound or in kept-out ground",
            "give a wider bound to explore on",
            {}};
  }
  return {EndKind::kComplete, known + "; " + what_remains(last.left_map), "", {}};
}

void Exploration::Impl::conclude(ExploreEnd end, RobotTime now, ExploreStep& out, std::optional<Point2> room_map) {
  if (end.kind == EndKind::kUnreachable) {
    out.events.push_back({"unreachable", end.cause});
  }
  if (end.kind == EndKind::kComplete) {
    progress_ = 1.0;
  }
  if (!request_.return_to_start && !room_map) {
    end_ = std::move(end);
    return;
  }
  mode_ = request_.return_to_start ? Mode::kReturn : Mode::kMakeRoom;
  name_last_drive(out);
  out.events.push_back({mode_ == Mode::kReturn ? "return" : "make-room", out.activity + ": " + end.cause});
  pending_end_ = std::move(end);
  last_drive_.go(mode_ == Mode::kReturn ? *start_ : *room_map, now);
}

std::optional<Point2> Exploration::Impl::room_for_others(const StrategyInput& input) {
  const bool somebody_explores =
      input.fleet != nullptr && std::any_of(input.fleet->others.begin(), input.fleet->others.end(),
                                            [](const RobotTopology& other) { return other.active; });
  const auto floor = floors_.view();
  if (!somebody_explores || !floor) {
    return std::nullopt;
  }
  const Point2 here = input.map_T_base.translation();
  const auto costs = nav::DistanceField::build((*floor)->cost, here);
  const bool in_the_way = costs && nav::blocks_passage((*floor)->cost, *costs, here, params_.viewpoints.min_cut_off_m2);
  return in_the_way ? nav::place_aside(here, **floor, *costs) : std::nullopt;
}

void Exploration::Impl::measure_progress(const StrategyInput& input) {
  const RobotTime now = input.now;
  if (pending_end_ || (measured_at_ && to_seconds(now - *measured_at_) < kProgressPeriod_s)) {
    return;
  }
  measured_at_ = now;
  const auto view = floors_.view();
  if (!view) {
    return;
  }
  const Grid<std::uint8_t>& floor = (*view)->reachable;
  const nav::CostMap& cost = (*view)->cost;
  const double cell_m = floor.frame().resolution_m;
  const auto unknown = [&](CellIndex c) {
    return cost.state(cost.frame().cell_of(floor.frame().centre_of(c))) == nav::CellState::kUnknown;
  };
  known_floor_.add(**view, input.map_T_base.translation(), params_.viewpoints.view_range_m);
  const double known_m2 = known_floor_.present_area_m2();
  double border_m = 0.0;
  for (CellIndex c{0, 0}; c.j < floor.height(); ++c.j) {
    for (c.i = 0; c.i < floor.width(); ++c.i) {
      if (floor[c] != 0) {
        const bool border =
            unknown({c.i + 1, c.j}) || unknown({c.i - 1, c.j}) || unknown({c.i, c.j + 1}) || unknown({c.i, c.j - 1});
        border_m += border ? cell_m : 0.0;
      }
    }
  }
  progress_ = known_m2 > 0.0 ? known_m2 / (known_m2 + kDepthBehindBorder_m * border_m) : 0.0;
}

}  // namespace seeker::explore
