#include <algorithm>
#include <utility>

#include "common/core/text.hpp"
#include "server/explore/exploration_impl.hpp"

namespace seeker::explore {
namespace {

/// Accelerating motors pull the voltage down for a moment.
constexpr double kBatterySag_s = 5.0;
/// Going back so often without having seen new floor in between does not help.
constexpr int kFruitlessRegains = 3;
/// Time between two plans of the return path, which are costly: the path grows in that time by no more than what
/// home_reserve_s covers.
constexpr double kTimeCheck_s = 5.0;
/// Where no return path is known at the moment, its length is estimated as the straight-line distance times this
/// factor.
constexpr double kDetour = 2.0;

}  // namespace

void Exploration::Impl::check_battery(const ExploreInput& input, ExploreStep& out) {
  const bool low = input.battery_v && *input.battery_v < params_.guard.battery_reserve_v;
  if (!low || !battery_checked_) {
    battery_low_since_.reset();
    return;
  }
  if (!battery_low_since_) {
    battery_low_since_ = input.now;
  }
  if (to_seconds(input.now - *battery_low_since_) < kBatterySag_s) {
    return;
  }
  battery_checked_ = false;
  const std::string cause = "the battery is down to its reserve (" + text(*input.battery_v) + " V)";
  out.events.push_back({"battery", cause});
  if (pending_end_) {
    return;  // it ends already
  }
  conclude({EndKind::kBattery, cause, "charge the battery, then explore again: the map so far is kept", {}},
           input.now - paused_, out);
}

/// The robot is to be home when its time is up, wherever it must come back to its start.
void Exploration::Impl::check_time(const ExploreInput& input, ExploreStep& out) {
  const bool due = !time_checked_at_ || to_seconds(input.now - *time_checked_at_) >= kTimeCheck_s;
  if (!input.time_left_s || !request_.return_to_start || pending_end_ || end_ || !due) {
    return;
  }
  time_checked_at_ = input.now;
  const double path_m = return_length_m(input.pose.map_T_base.translation());
  const GuardParams& guard = params_.guard;
  if (*input.time_left_s > guard.home_margin * path_m / guard.home_m_s + guard.home_reserve_s) {
    return;
  }
  const std::string cause = "the remaining time is needed for the return path of " + text(path_m) + " m (" +
                            text(*input.time_left_s) + " s left)";
  out.events.push_back({"time", cause});
  conclude({EndKind::kTimeLimit, cause, "give it more with --time-limit: the map so far is kept", {}},
           input.now - paused_, out);
}

double Exploration::Impl::return_length_m(const Point2& here_map) {
  const auto floor = floors_.view();
  const auto path =
      floor ? nav::plan((*floor)->cost, here_map, *start_) : Result<nav::Path>(tl::unexpected<Error>(floor.error()));
  return path ? path->length_m : kDetour * (*start_ - here_map).norm();
}

void Exploration::Impl::check_certainty(const StrategyInput& input, double sigma_m, ExploreStep& out) {
  if (mode_ == Mode::kExplore && !end_ && sigma_m > params_.guard.max_position_sigma_m) {
    begin_regain(input, sigma_m, out);
  }
}

void Exploration::Impl::begin_regain(const StrategyInput& input, double sigma_m, ExploreStep& out) {
  fruitless_regains_ = known_floor_.present_area_m2() > floor_at_regain_m2_ + kNewFloor_m2 ? 0 : fruitless_regains_ + 1;
  floor_at_regain_m2_ = std::max(floor_at_regain_m2_, known_floor_.present_area_m2());  // people hide some at times
  const std::string cause = "the robot's position is uncertain by " + text(sigma_m) + " m";
  if (fruitless_regains_ > kFruitlessRegains) {
    end_ =
        ExploreEnd{EndKind::kUncertain,
                   cause + ", again at the same place",
                   "what is left cannot be explored with so much certainty: raise the limit, or add objects that the "
                   "robot can recognise there",
                   {}};
    return;
  }
  mode_ = Mode::kRegain;
  got_back_ = input.now;
  back_driving_ = false;
  const std::vector<Point2> path = trail_.path_to_certainty();
  regain_path_.assign(path.begin(), path.end());
  out.events.push_back({"uncertain", cause + "; going back along its trail to where it was certain"});
}

void Exploration::Impl::regain(const StrategyInput& input, double sigma_m, ExploreStep& out) {
  out.phase = "regain";
  out.activity = "going back to where the robot was certain of its position, now " + text(sigma_m) + " m";
  // Where it was most certain it will not become more certain by waiting: below the limit, that is good enough.
  const bool back = regain_path_.empty() && sigma_m < params_.guard.max_position_sigma_m;
  if (back || sigma_m < params_.guard.regain_position_sigma_m) {
    out.events.push_back({"certain", "the robot's position is certain to " + text(sigma_m) + " m again"});
    mode_ = Mode::kExplore;
    trail_.cut_after(input.map_T_base.translation());
    strategy_->interrupted(input.now);
    out.step_done = true;
    return;
  }
  if (to_seconds(input.now - got_back_) > params_.guard.regain_time_s) {
    end_ = ExploreEnd{EndKind::kUncertain,
                      "the robot's position is uncertain by " + text(sigma_m) + " m, and going back did not help",
                      "localise the robot, then explore again: the map so far is kept",
                      {}};
    return;
  }
  if (regain_path_.empty()) {
    out.activity = "waiting where the robot was most certain of its position";
    return;
  }
  if (!std::exchange(back_driving_, true)) {
    back_.go(regain_path_.front(), input.now);
  }
  const nav::DriveStep driven = back_.step(input);
  out.command = driven.command;
  out.planned_path = back_.path();
  if (driven.state == nav::DriveState::kArrived) {
    got_back_ = input.now;  // a long return path takes long
  }
  if (driven.state != nav::DriveState::kDriving) {  // arrived, or no path there: on to the next
    regain_path_.pop_front();
    back_driving_ = false;
  }
}

void Exploration::Impl::last_drive(const StrategyInput& input, ExploreStep& out) {
  name_last_drive(out);
  const nav::DriveStep driven = last_drive_.step(input);
  out.command = driven.command;
  out.planned_path = last_drive_.path();
  if (driven.state == nav::DriveState::kFailed) {
    const std::string path =
        mode_ == Mode::kReturn ? "return path to the start" : "path out of the way of other robots";
    pending_end_->cause += "; the " + path + " is blocked: " + driven.reason;
  }
  if (driven.state != nav::DriveState::kDriving) {
    end_ = std::move(pending_end_);
  }
}

void Exploration::Impl::name_last_drive(ExploreStep& out) const {
  out.phase = mode_ == Mode::kReturn ? "return" : "drive";
  out.activity = mode_ == Mode::kReturn ? "driving back to the start" : "driving out of the way of other robots";
}

}  // namespace seeker::explore
