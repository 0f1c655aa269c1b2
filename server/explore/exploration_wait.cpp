#include <algorithm>
#include <cmath>

#include "common/core/text.hpp"
#include "server/explore/exploration_impl.hpp"
#include "server/nav/lookout.hpp"

namespace seeker::explore {

/// Drives to a place in sight of the blocked place, or aside of the person who blocks it, and stands there.
void Exploration::Impl::begin_wait(const nav::PlannedWait& planned, const StrategyInput& input, ExploreStep& out) {
  // The most so far: floor that comes back when somebody has walked by is no new floor.
  floor_at_wait_m2_ = std::max(floor_at_wait_m2_, known_floor_.present_area_m2());
  waiting_since_ = input.now;
  out.phase = "wait";
  out.activity = "waiting for the path to " + text(planned.p_map) + " to become free again";
  Point2 place = input.map_T_base.translation();
  if (const auto floor = floors_.view()) {
    if (const auto costs = nav::DistanceField::build((*floor)->cost, place)) {
      const auto found = planned.aside ? nav::place_aside(planned.p_map, **floor, *costs)
                                       : nav::lookout_for(planned.p_map, **floor, *costs);
      place = found.value_or(place);
    }
  }
  const Point2 to = planned.p_map - place;
  if (!lookout_.start(input, place, std::atan2(to.y(), to.x()))) {
    out.activity += "; no path to the place for waiting: " + lookout_.reason();
  }
}

/// False: there is nothing to wait for, or no longer.
bool Exploration::Impl::waits(const StrategyInput& input, ExploreStep& out) {
  if (!waiting_since_) {
    return false;
  }
  const nav::DriveStep driven = lookout_.step(input);
  if (driven.state == nav::DriveState::kDriving) {
    waiting_since_ = input.now;
  } else if (to_seconds(input.now - *waiting_since_) >= params_.viewpoints.retry_s) {
    waiting_since_.reset();
    strategy_->try_again(input.now);
    return false;
  }
  out.command = driven.command;
  out.planned_path = lookout_.path();
  out.phase = "wait";
  out.activity = "waiting for the path to become free again";
  return true;
}

/// Gives somebody who blocks the path some time to move on, after which the places that could not be reached are tried
/// again.
void Exploration::Impl::strategy_done(const StrategyStep& last, const StrategyInput& input, ExploreStep& out) {
  const Left left = what_is_left(input);
  if (known_floor_.present_area_m2() > floor_at_wait_m2_ + kNewFloor_m2) {
    wait_schedule_.reset();
  }
  std::vector<nav::BlockedPlace> places = left.cut_off;
  for (const Point2& p_map : left.people.at_map) {
    places.push_back({p_map, true});
  }
  // Who closes in on it may go on, and what sonars alone have seen is forgotten after a while.
  if (const Point2 here = input.map_T_base.translation(); left.no_floor && known_floor_.was_reachable(here)) {
    places.push_back({here, true});
  }
  for (const UnreachablePlace& place : last.unreachable) {
    if (last.tries_again) {
      places.push_back({place.p_map, false});
    }
  }
  if (const auto planned = wait_schedule_.next(places)) {
    begin_wait(*planned, input, out);
    return;
  }
  conclude(end_for(left, last, input.map_T_base.translation()), input.now, out, room_for_others(input));
}

}  // namespace seeker::explore
