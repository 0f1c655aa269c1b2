#include "server/explore/exploration_impl.hpp"

#include <utility>

namespace seeker::explore {
namespace {

/// Number of attempts for each place of the path to certainty: the next place may be as good.
constexpr int kBackAttempts = 2;

}  // namespace

Exploration::Impl::Impl(const ExploreRequest& request, const ExploreParams& params,
                        std::unique_ptr<ExploreStrategy> strategy)
    : request_(request),
      params_(params),
      strategy_(std::move(strategy)),
      floors_(params.cost, request.areas, params.floor_cell_m, params.map_period_s),
      last_drive_(params.driver, {}),
      back_(params.driver, {.attempts = kBackAttempts}),
      lookout_(params.driver),
      wait_schedule_({.max_waits = params.viewpoints.max_waits, .max_for_nobody = params.viewpoints.max_failures}) {}

StrategyInput Exploration::Impl::strategy_input(const ExploreInput& input) {
  return {{input.now - paused_, input.pose.map_T_base, input.sonar, input.laser, floors_},
          input.velocity,
          input.pose.covariance,
          input.segments,
          input.segments_revision,
          input.belief,
          input.fleet,
          request_.return_to_start ? start_ : std::nullopt,
          &trail_};
}

ExploreStep Exploration::Impl::step(const ExploreInput& input) {
  ExploreStep out;
  out.phase = "done";
  const RobotTime before = last_now_.value_or(input.now);
  last_now_ = input.now;
  if (!end_) {
    if (const std::string why = cause_to_stand(input); !why.empty()) {
      paused_ += standing_ ? input.now - before : Duration{0};
      stand(input, why, out);
    } else {
      act(input, out);
    }
  }
  if (end_) {
    out.command = {};
    out.phase = "done";
    out.activity = end_->cause;
    out.planned_path.clear();
    out.step_done = true;
    out.end = end_;
  }
  out.progress = progress_;
  if (out.decision) {
    out.decision->number = ++decisions_;
    out.decision->stamp = input.now;
  }
  return out;
}

std::string Exploration::Impl::cause_to_stand(const ExploreInput& input) const {
  const LocalisationQuality quality = input.pose.quality;
  if (quality == LocalisationQuality::kLost || quality == LocalisationQuality::kUnknown ||
      !is_finite(input.pose.map_T_base) || !input.pose.covariance.allFinite()) {
    return "the robot does not know where it is" + (input.pose.cause.empty() ? "" : ": " + input.pose.cause);
  }
  if (input.laser == nullptr && input.sonar == nullptr) {
    return "there are no range readings";
  }
  return {};
}

/// Time of standing does not count for drives; too long of it ends the exploration.
void Exploration::Impl::stand(const ExploreInput& input, const std::string& why, ExploreStep& out) {
  if (!std::exchange(standing_, true)) {
    lost_since_ = input.now;
  }
  out.phase = "stopped";
  out.activity = why + "; standing still";
  if (to_seconds(input.now - lost_since_) <= params_.guard.regain_time_s) {
    return;
  }
  if (pending_end_) {  // the exploration itself was over, and its own end is what counts
    end_ = std::move(pending_end_);
    end_->cause += (mode_ == Mode::kReturn ? "; not back at the start: " : "; in the way of other robots: ") + why;
  } else {
    end_ = ExploreEnd{EndKind::kUncertain,
                      why,
                      "localise the robot or look after its range sensors, then explore again: the map so far is kept",
                      {}};
  }
}

void Exploration::Impl::begin(const ExploreInput& input) {
  if (!start_) {
    start_ = input.pose.map_T_base.translation();
  }
  if (std::exchange(standing_, false)) {
    strategy_->interrupted(input.now - paused_);
    last_drive_.interrupted();
    back_.interrupted();
    lookout_.stop();
  }
}

void Exploration::Impl::act(const ExploreInput& input, ExploreStep& out) {
  begin(input);
  floors_.attend(input.map, input.pose.map_T_base, input.now - paused_, input.movers,
                 input.fleet != nullptr ? input.fleet->floor : nullptr);
  const StrategyInput now = strategy_input(input);
  sonar_obstacles_.note(now);
  measure_progress(now);
  const double sigma_m = position_sigma_m(input.pose.covariance);
  check_battery(input, out);
  check_time(input, out);
  check_certainty(now, sigma_m, out);
  if (end_) {
    return;
  }
  switch (mode_) {
    case Mode::kExplore:
      trail_.note(now.map_T_base.translation(), sigma_m);
      explore(now, out);
      break;
    case Mode::kRegain: regain(now, sigma_m, out); break;
    case Mode::kReturn:
    case Mode::kMakeRoom: last_drive(now, out); break;
  }
}

void Exploration::Impl::explore(const StrategyInput& input, ExploreStep& out) {
  if (waits(input, out)) {
    return;
  }
  StrategyStep step = strategy_->step(input);
  if (step.done) {
    out.decision = std::move(step.decision);
    strategy_done(step, input, out);
    return;
  }
  hand_over(std::move(step), out);
}

void Exploration::Impl::hand_over(StrategyStep&& from, ExploreStep& out) {
  note_traps(from.phase, from.activity, out);
  out.command = from.command;
  out.phase = std::move(from.phase);
  out.activity = std::move(from.activity);
  out.planned_path = std::move(from.planned_path);
  out.step_done = from.step_done;
  out.decision = std::move(from.decision);
}

void Exploration::Impl::note_traps(const std::string& phase, const std::string& activity, ExploreStep& out) {
  const bool was_wall = last_phase_ == "wall";
  const bool is_wall = phase == "wall";
  if (is_wall && !was_wall) {
    out.events.push_back({"trap", activity});
  } else if (was_wall && !is_wall) {
    out.events.push_back({"escape", activity});
  }
  last_phase_ = phase;
}

void Exploration::Impl::resume(RobotTime now) {
  if (!last_now_) {
    return;
  }
  paused_ += now - *last_now_;
  lost_since_ += now - *last_now_;
  last_now_ = now;
  battery_low_since_.reset();
  strategy_->interrupted(now - paused_);
  last_drive_.interrupted();
  back_.interrupted();
  lookout_.stop();
}

void Exploration::Impl::transform(const MapMove& move) {
  strategy_->transform(move);
  floors_.transform(move);
  sonar_obstacles_.transform(move);
  trail_.transform(move);
  known_floor_.transform(move);
  wait_schedule_.transform(move);
  last_drive_.transform(move);
  back_.transform(move);
  lookout_.stop();
  if (start_) {
    start_ = move * *start_;
  }
  for (Point2& p : regain_path_) {
    p = move * p;
  }
  for (const auto& end : {&pending_end_, &end_}) {
    if (*end) {
      for (UnreachablePlace& place : (*end)->unreachable) {
        place.p_map = move * place.p_map;
      }
    }
  }
}

}  // namespace seeker::explore
