#include "server/explore/place_strategy.hpp"

#include <algorithm>
#include <utility>

#include "common/core/angle.hpp"
#include "common/core/text.hpp"

namespace seeker::explore {
namespace {

constexpr double kRotation_rad_s = 0.6;
constexpr double kWaitTick_s = 1.0;
/// A viewpoint that moved by less is the same.
constexpr double kSameView_m = 0.3;

Opening moved(Opening opening, const MapMove& move) {
  const Pose2 new_T_old = move.at(opening.p_map);
  const Point2 ahead = new_T_old * Point2(opening.p_map + opening.outward_map);
  opening.p_map = new_T_old * opening.p_map;
  opening.outward_map = ahead - opening.p_map;
  opening.map_T_view = move * opening.map_T_view;
  return opening;
}

}  // namespace

DecisionCandidate candidate_of(const Opening& opening, double score) {
  DecisionCandidate candidate;
  candidate.map_T_base = opening.map_T_view;
  candidate.path_m = opening.cost;
  candidate.score = score;
  return candidate;
}

PlaceStrategy::PlaceStrategy(const ExploreParams& params, std::unique_ptr<PlaceChooser> chooser)
    : params_(params),
      chooser_(std::move(chooser)),
      manner_(
          chooser_->manner().value_or(DriveManner{false, params.viewpoints.replan_period_s, params.viewpoints.look_s})),
      openings_(params.viewpoints),
      driver_(params.driver) {}

StrategyStep PlaceStrategy::step(const StrategyInput& input) {
  StrategyStep out;
  out.phase = "drive";
  const Point2 here = input.map_T_base.translation();
  began_map_ = began_map_.value_or(here);
  looked_round_ = looked_round_ || (here - *began_map_).norm() > params_.viewpoints.reached_m;
  switch (state_) {
    case State::kChoose: choose(input, out); break;
    case State::kDrive: drive(input, out); break;
    case State::kLook: look(input, out); break;
    case State::kRotate: rotate(input, out); break;
    case State::kWait:
      if (to_seconds(input.now - since_) >= kWaitTick_s) {
        choose(input, out);
      }
      break;
    case State::kDone: break;
  }
  if (out.activity.empty()) {
    out.activity = why_;
  }
  if (state_ == State::kWait) {
    out.phase = "wait";
  }
  if (state_ == State::kDone) {
    out.done = true;
    out.unreachable = openings_.given_up();
    out.left_map = left_map_;
    out.tries_again = true;
  } else if (state_ == State::kDrive) {
    out.planned_path = driver_.path();
  }
  return out;
}

Result<PlaceStrategy::Survey> PlaceStrategy::survey(const StrategyInput& input, bool fresh) {
  auto floor = input.floors.view(fresh);
  if (!floor) {
    return tl::unexpected(floor.error());
  }
  auto costs = nav::DistanceField::build((*floor)->cost, input.map_T_base.translation());
  if (!costs) {
    return tl::unexpected(costs.error());
  }
  Survey found{*floor, std::move(*costs), {}, false};
  OpeningsInput scene{**floor,
                      found.costs,
                      input.segments,
                      input.floors.areas(),
                      input.map_T_base,
                      input.now,
                      chooser_->wants_wall_ends()};
  scene.others_sides = input.others_sides();
  for (Opening& opening : openings_.find(scene)) {
    if (opening.resting) {
      found.resting = true;
    } else {
      found.open.push_back(std::move(opening));
    }
  }
  return found;
}

void PlaceStrategy::choose(const StrategyInput& input, StrategyStep& out) {
  auto found = survey(input, manner_.flowing);
  if (!found) {
    if (rotated_) {
      finish(found.error().message, out);
      return;
    }
    begin_rotation(input, "rotating on the spot to see more: " + found.error().message, out);
    return;
  }
  rotated_ = false;
  choose_from(input, *found, out);
  if (manner_.flowing && state_ == State::kDrive) {
    drive(input, out);
  }
}

void PlaceStrategy::choose_from(const StrategyInput& input, const Survey& found, StrategyStep& out) {
  since_ = input.now;
  considered_ = input.now;
  left_map_.clear();
  others_busy_ = false;
  if (found.open.empty()) {
    wait_or_finish(input, found, out);
    return;
  }
  go(input, chooser_->choose({input, *found.floor, found.costs, found.open}), out);
  if (!goal_ && !others_busy_) {
    std::transform(found.open.begin(), found.open.end(), std::back_inserter(left_map_),
                   [](const Opening& opening) { return opening.p_map; });
  }
  if (!goal_) {
    wait_or_finish(input, found, out);
  }
}

void PlaceStrategy::wait_or_finish(const StrategyInput& input, const Survey& found, StrategyStep& out) {
  goal_.reset();
  out.command = {};  // that of the drive which has just ended
  if (others_busy_) {
    if (state_ == State::kWait) {
      out.decision.reset();  // that of the last second
    }
    state_ = State::kWait;
    why_ = "waiting while other robots see to what is left";
    return;
  }
  if (found.resting) {
    state_ = State::kWait;
    why_ = "waiting to try again what could not be reached";
    return;
  }
  if (!looked_round_) {
    // One scan, or the first few cells of a map, may hold no border that is long enough; nor does a wall close by.
    begin_rotation(input, "rotating on the spot to see what is around the start", out);
    return;
  }
  finish("nothing is left to explore", out);
}

void PlaceStrategy::finish(std::string why, StrategyStep& out) {
  goal_.reset();
  driver_.stop();
  state_ = State::kDone;
  why_ = std::move(why);
  out.step_done = true;
}

void PlaceStrategy::go(const StrategyInput& input, PlaceChoice choice, StrategyStep& out) {
  goal_ = std::move(choice.opening);
  via_map_ = choice.via_map;
  others_busy_ = choice.others_busy;
  out.decision = std::move(choice.decision);
  if (!goal_) {
    return;
  }
  set_out(input);
}

void PlaceStrategy::set_out(const StrategyInput& input) {
  since_ = input.now;
  corrected_ = false;
  facing_ = false;
  why_ = "driving to observe " + describe(*goal_) + " at " + text(goal_->p_map);
  const Point2 place = via_map_.value_or(goal_->map_T_view.translation());
  const bool turns = !manner_.flowing && !via_map_;
  if (driver_.start(input, place, turns ? std::optional(goal_->map_T_view.theta_rad) : std::nullopt)) {
    state_ = State::kDrive;
    return;
  }
  if (via_map_) {
    via_map_.reset();  // then without it
    set_out(input);
    return;
  }
  openings_.failed(*goal_, input.now);
  why_ = "no path to " + describe(*goal_) + ": " + driver_.reason();
  state_ = State::kChoose;
}

void PlaceStrategy::drive(const StrategyInput& input, StrategyStep& out) {
  const nav::DriveStep driven = driver_.step(input);
  out.command = driven.command;
  switch (driven.state) {
    case nav::DriveState::kDriving:
      if (to_seconds(input.now - considered_) >= manner_.replan_period_s) {
        reconsider(input, out);
      }
      return;
    case nav::DriveState::kArrived: arrive(input); return;
    case nav::DriveState::kFailed:
    case nav::DriveState::kIdle:
      if (std::exchange(via_map_, std::nullopt)) {
        set_out(input);  // what did not lead to the place on the way may lead to the goal
        return;
      }
      openings_.failed(*goal_, input.now);
      why_ = "no path to " + describe(*goal_) + ": " + driven.reason;
      state_ = State::kChoose;
      return;
  }
}

void PlaceStrategy::arrive(const StrategyInput& input) {
  since_ = input.now;
  if (std::exchange(via_map_, std::nullopt)) {
    state_ = State::kChoose;
    return;
  }
  const Point2 behind = goal_->p_map + params_.viewpoints.reached_m * goal_->outward_map;
  const bool in_view = std::abs(bearing_to(input.map_T_base, behind)) < params_.one_step.sensor.half_angle_rad;
  if (manner_.flowing && !facing_ && !in_view &&
      driver_.start(input, input.map_T_base.translation(), goal_->map_T_view.theta_rad)) {
    facing_ = true;
    return;
  }
  state_ = State::kLook;
}

/// While driving: checks whether the goal is still open and still the best.
void PlaceStrategy::reconsider(const StrategyInput& input, StrategyStep& out) {
  considered_ = input.now;
  const auto found = survey(input);
  if (!found) {
    return;  // the drive itself detects when the path is lost
  }
  const auto same = std::find_if(found->open.begin(), found->open.end(),
                                 [&](const Opening& opening) { return opening.id == goal_->id; });
  if (same == found->open.end()) {
    out.step_done = true;
    out.activity = describe(*goal_) + " was observed on the path";
    state_ = State::kChoose;
    if (manner_.flowing) {
      choose_from(input, *found, out);
    }
    return;
  }
  if (facing_) {
    return;
  }
  if (!chooser_->changes_its_mind()) {
    follow_correction(input, *same);
    return;
  }
  const Opening present = *goal_;
  PlaceChoice choice = chooser_->choose({input, *found->floor, found->costs, found->open, &present});
  const bool other = choice.opening && choice.opening->id != present.id;
  const bool moved =
      manner_.flowing && choice.opening && distance_m(choice.opening->map_T_view, present.map_T_view) > kSameView_m;
  if (choice.opening && (corrected_ || other || moved)) {
    const bool decided = other || corrected_;
    go(input, std::move(choice), out);
    if (!decided) {
      out.decision.reset();  // the same goal from another viewpoint
    }
  }
}

/// The map bent: the place moved otherwise than the robot did.
void PlaceStrategy::follow_correction(const StrategyInput& input, const Opening& same) {
  if (!corrected_) {
    return;
  }
  const Point2 shift = same.p_map - goal_->p_map;
  goal_->p_map += shift;
  goal_->map_T_view.x_m += shift.x();
  goal_->map_T_view.y_m += shift.y();
  set_out(input);
}

void PlaceStrategy::look(const StrategyInput& input, StrategyStep& out) {
  out.activity = "observing " + describe(*goal_);
  if (to_seconds(input.now - since_) < manner_.look_s) {
    return;
  }
  openings_.looked(*goal_, input.now);
  goal_.reset();
  state_ = State::kChoose;
  out.step_done = true;
}

void PlaceStrategy::begin_rotation(const StrategyInput& input, std::string why, StrategyStep& out) {
  why_ = std::move(why);
  state_ = State::kRotate;
  since_ = input.now;
  rotate(input, out);
}

void PlaceStrategy::rotate(const StrategyInput& input, StrategyStep& out) {
  out.phase = "turn";
  if (to_seconds(input.now - since_) > kTwoPi / kRotation_rad_s) {
    rotated_ = true;
    looked_round_ = true;
    state_ = State::kChoose;
    return;
  }
  out.command.omega_rad_s = kRotation_rad_s;
}

void PlaceStrategy::interrupted(RobotTime now) {
  since_ = now;
  start_again();
}

void PlaceStrategy::try_again(RobotTime now) {
  openings_.try_again();
  interrupted(now);
}

void PlaceStrategy::transform(const MapMove& move) {
  openings_.transform(move);
  driver_.transform(move);
  if (goal_) {
    goal_ = moved(std::move(*goal_), move);
  }
  if (via_map_) {
    via_map_ = move * *via_map_;
  }
  for (Point2& p_map : left_map_) {
    p_map = move * p_map;
  }
  if (began_map_) {
    began_map_ = move * *began_map_;
  }
  corrected_ = true;
}

std::optional<Point2> PlaceStrategy::target_map() const {
  return goal_ ? std::optional(goal_->map_T_view.translation()) : std::nullopt;
}

void PlaceStrategy::start_again() {
  driver_.stop();
  goal_.reset();
  via_map_.reset();
  rotated_ = false;
  corrected_ = false;
  state_ = State::kChoose;
}

}  // namespace seeker::explore
