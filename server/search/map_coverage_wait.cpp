#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "common/core/text.hpp"
#include "server/nav/lookout.hpp"
#include "server/search/cut_off.hpp"
#include "server/search/map_coverage.hpp"

namespace seeker::search {
namespace {

double area_m2(const Grid<std::uint8_t>& floor) {
  const auto cells = std::count_if(floor.cells().begin(), floor.cells().end(), [](auto cell) { return cell != 0; });
  return floor.frame().resolution_m * floor.frame().resolution_m * static_cast<double>(cells);
}

}  // namespace

void MapCoverage::nothing_left(const StrategyInput& input, const nav::FloorView& floor, const nav::DistanceField& costs,
                               StrategyStep& out) {
  std::vector<nav::BlockedPlace> places =
      blocked_places(floor, input.known, input.evidence, {params_.min_cut_off_m2, params_.min_frontier_m});
  // The robot waits for a place that was not reached where evidence can still be gained there.
  const std::vector<Point2> nowhere;
  if (const auto goal = failed_.empty() ? std::nullopt : chooser_->choose(choice(input, floor, costs, nowhere))) {
    places.push_back({goal->p_map, false});
  }
  if (const auto planned = waits_.next(places)) {
    begin_wait(*planned, input, floor, costs, out);
    return;
  }
  state_ = State::kDone;
  // Floor lies all around, and of it the robot has what it stands on.
  trapped_ = !places.empty() && area_m2(floor.reachable) < params_.cell_m * params_.cell_m;
  cause_ = trapped_ ? "no path leads out of where the robot stands" : "no reachable gap and no frontier is left";
  update_lists(input);
}

/// Drives to a place in sight of the blocked place, or aside of the person who blocks it, and stands there.
void MapCoverage::begin_wait(const nav::PlannedWait& planned, const StrategyInput& input, const nav::FloorView& floor,
                             const nav::DistanceField& costs, StrategyStep& out) {
  stand_waiting("waiting for the path to " + text(planned.p_map) + " to become free again", input, out);
  const auto found =
      planned.aside ? nav::place_aside(planned.p_map, floor, costs) : nav::lookout_for(planned.p_map, floor, costs);
  const Point2 place = found.value_or(input.map_T_base.translation());
  const Point2 to = planned.p_map - place;
  if (!driver_.start(input, place, std::atan2(to.y(), to.x()))) {
    out.activity += "; no path to the place for waiting: " + driver_.reason();
  }
}

bool MapCoverage::wait_enclosed(const StrategyInput& input, StrategyStep& out) {
  const bool came_here = !searched_cells_.empty();
  if (!came_here || !waits_.next({{input.map_T_base.translation(), true}})) {
    return false;
  }
  driver_.stop();
  rotations_ = 0;
  stand_waiting("waiting for whoever stands against the robot to go on", input, out);
  return true;
}

void MapCoverage::stand_waiting(std::string what, const StrategyInput& input, StrategyStep& out) {
  state_ = State::kWait;
  waiting_since_ = input.now;
  out.phase = "wait";
  out.events.push_back({"wait", what});
  out.activity = std::move(what);
}

void MapCoverage::wait(const StrategyInput& input, StrategyStep& out) {
  out.phase = "wait";
  out.activity = "waiting for the path to become free again";
  const nav::DriveStep driven = driver_.step(input);
  out.command = driven.command;
  out.planned_path = driver_.path();
  if (driven.state == nav::DriveState::kDriving) {
    waiting_since_ = input.now;
    return;
  }
  if (to_seconds(input.now - waiting_since_) < params_.retry_s) {
    return;
  }
  input.floors.forget_past_obstacles();  // who is still there is met again
  for (Failed& one : failed_) {          // once more each
    one.times = std::min(one.times, params_.max_failures - 1);
    one.last = input.now - seconds(params_.retry_s);
  }
  list_unreachable();
  state_ = State::kChoose;
}

}  // namespace seeker::search
