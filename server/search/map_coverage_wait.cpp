#include <algorithm>
#include <cmath>
#include <cstdint>

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
  // What was not reached is waited for where something is still to be had from it.
  const std::vector<Point2> nowhere;
  if (const auto goal = failed_.empty() ? std::nullopt : chooser_->choose(choice(input, floor, costs, nowhere))) {
    places.push_back({goal->p_map, false});
  }
  if (const auto turn = waits_.next(places)) {
    begin_wait(*turn, input, floor, costs, out);
    return;
  }
  state_ = State::kDone;
  // Floor lies all around, and of it the robot has what it stands on.
  trapped_ = !places.empty() && area_m2(floor.reachable) < params_.cell_m * params_.cell_m;
  cause_ = trapped_ ? "no way leads out of where the robot stands" : "no reachable gap and no frontier is left";
  update_lists(input);
}

/// Goes to where it sees the place, or out of the way of who is there, and stands there.
void MapCoverage::begin_wait(const nav::WaitTurn& turn, const StrategyInput& input, const nav::FloorView& floor,
                             const nav::DistanceField& costs, StrategyStep& out) {
  state_ = State::kWait;
  waiting_since_ = input.now;
  const std::string where = "waiting for the way to " + text(turn.p_map) + " to become free again";
  out.events.push_back({"wait", where});
  out.phase = "wait";
  out.activity = where;
  const auto found =
      turn.aside ? nav::place_aside(turn.p_map, floor, costs) : nav::lookout_for(turn.p_map, floor, costs);
  const Point2 place = found.value_or(input.map_T_base.translation());
  const Point2 to = turn.p_map - place;
  if (!driver_.start(input, place, std::atan2(to.y(), to.x()))) {
    out.activity += "; no way to where one would wait: " + driver_.reason();
  }
}

void MapCoverage::wait(const StrategyInput& input, StrategyStep& out) {
  out.phase = "wait";
  out.activity = "waiting for the way to become free again";
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
