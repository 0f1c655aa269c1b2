#include "server/search/paper_coverage.hpp"

#include <cmath>
#include <utility>

#include "common/core/angle.hpp"
#include "common/core/text.hpp"

namespace seeker::search {
namespace {

constexpr double kBackSpeed_m_s = 0.1;
constexpr double kBackLag_s = 1.0;  ///< to gather speed
/// A recovery rotates by at least this angle, because otherwise it would end where it began.
constexpr double kMinRecoveryRotation_rad = deg_to_rad(40.0);

int first_limit(const PaperParams& params) {
  return params.passes_limit > 0 ? params.passes_limit : passes_limit(params.area_m2, params.cell_m * params.cell_m);
}

}  // namespace

PaperCoverage::PaperCoverage(const PaperParams& params, LocalPlanner planner, nav::ForbiddenAreas areas)
    : params_(params),
      planner_(std::move(planner)),
      areas_(std::move(areas)),
      lists_(params.cell_m, first_limit(params)) {}

StrategyStep PaperCoverage::step(const StrategyInput& input) {
  StrategyStep out;
  const auto sectors = planner_.sense(input.sonar, input.map_T_base, input.now);
  if (!sectors) {
    out.phase = "stopped";
    out.activity = sectors.error().message;
    if (!std::exchange(blind_, true)) {
      out.events.push_back({"sensor_stop", sectors.error().message});
    }
    restart_ = true;
    return out;
  }
  blind_ = false;
  if (std::exchange(restart_, false)) {
    motion_.start(input.map_T_base.translation(), input.now);
    progress_.start(input.now);
  }
  switch (state_) {
    case State::kArrive: arrive(input, *sectors, out); break;
    case State::kLook:
      out.phase = "look";
      out.activity = "taking a picture at " + text(cell_);
      out.wants_image = true;
      break;
    case State::kMove: move(input, *sectors, out); break;
    case State::kEscape: escape(input, *sectors, out); break;
    case State::kRecover: recover(input, *sectors, out); break;
    case State::kDone: break;
  }
  if (state_ == State::kDone) {
    out.done = true;
    out.trapped = trapped_;
    out.activity = trapped_ ? "the local planner finds no path out" : "no unsearched position is left";
    out.command = {};
  }
  return out;
}

void PaperCoverage::note_potential_cells(const StrategyInput& input, const Sectors& sectors, StrategyStep& out) {
  for (const auto& [sector, alpha] : {std::pair{Sector::kLeft, kPi / 2.0}, std::pair{Sector::kRight, -kPi / 2.0}}) {
    if (!(sectors[sector] > params_.sonar_limit_m)) {
      continue;
    }
    const Point2 p = potential_cell(input.map_T_base, alpha, params_.cell_m, params_.robot_radius_m).translation();
    if (areas_.allows(p) && lists_.note_potential(p)) {
      out.events.push_back({"cell_unsearched", "unsearched position " + text(p)});
    }
  }
}

void PaperCoverage::arrive(const StrategyInput& input, const Sectors& sectors, StrategyStep& out) {
  note_potential_cells(input, sectors, out);
  cell_ = input.map_T_base.translation();
  recoveries_ = 0;
  switch (lists_.arrive(cell_)) {
    case Arrival::kFresh:
      out.events.push_back({"cell_searched", "new position " + text(cell_)});
      out.activity = "arrived at a new position " + text(cell_);
      state_ = State::kLook;
      break;
    case Arrival::kPass:
      out.activity = "passing a searched position, pass " + std::to_string(lists().passes_n) + " of " +
                     std::to_string(lists().passes_limit_n);
      begin_move(input);
      break;
    case Arrival::kSearchWell:
      out.activity = "this part is searched well";
      out.events.push_back({"search_well", "searched well around " + text(cell_)});
      begin_escape(input, out);
      break;
  }
}

void PaperCoverage::begin_move(const StrategyInput& input) {
  state_ = State::kMove;
  motion_.start(input.map_T_base.translation(), input.now);
}

void PaperCoverage::begin_escape(const StrategyInput& input, StrategyStep& out) {
  const auto goal = lists_.nearest_unsearched(input.map_T_base.translation());
  if (!goal) {
    state_ = State::kDone;
    return;
  }
  goal_ = *goal;
  state_ = State::kEscape;
  recoveries_ = 0;
  progress_.start(input.now);
  motion_.start(input.map_T_base.translation(), input.now);
  out.events.push_back({"escape", "driving to the unsearched position " + text(goal_)});
}

void PaperCoverage::follow(const Sectors& sectors, double target_rad, StrategyStep& out) {
  const auto command = planner_.drive(sectors, target_rad);
  if (command) {
    out.command = *command;
  } else {
    out.phase = "stopped";
    out.activity = command.error().message;
  }
}

bool PaperCoverage::stuck(const StrategyInput& input) {
  return motion_.idle_s(input.map_T_base.translation(), params_.stuck_move_m, input.now) > params_.stuck_time_s;
}

void PaperCoverage::move(const StrategyInput& input, const Sectors& sectors, StrategyStep& out) {
  if ((input.map_T_base.translation() - cell_).norm() > params_.cell_m) {
    state_ = State::kArrive;
    out.activity = "one cell further";
    return;
  }
  if (stuck(input)) {
    after_recovery_ = State::kMove;
    begin_recovery(input, sectors, out);
    return;
  }
  out.activity = "moving on from " + text(cell_);
  follow(sectors, 0.0, out);
}

void PaperCoverage::escape(const StrategyInput& input, const Sectors& sectors, StrategyStep& out) {
  out.phase = "escape";
  out.planned_path = {input.map_T_base.translation(), goal_};
  const Point2 here = input.map_T_base.translation();
  const Point2 offset = goal_ - here;
  if (offset.lpNorm<Eigen::Infinity>() <= params_.cell_m / 2.0) {
    cell_ = here;
    lists_.escaped(goal_, here);
    out.events.push_back({"cell_searched", "unsearched position " + text(goal_) + " reached"});
    out.activity = "arrived at an unsearched position";
    state_ = State::kLook;
    return;
  }
  if (progress_.idle_s(offset.norm(), params_.progress_m, input.now) > params_.progress_time_s) {
    give_up_escape(input, "no progress", out);
    return;
  }
  if (progress_.total_s(input.now) > params_.reach_time_s) {
    give_up_escape(input, "not reached in time", out);
    return;
  }
  if (stuck(input)) {
    after_recovery_ = State::kEscape;
    begin_recovery(input, sectors, out);
    return;
  }
  out.activity = "driving to the unsearched position " + text(goal_);
  follow(sectors, bearing_to(input.map_T_base, goal_), out);
}

void PaperCoverage::give_up_escape(const StrategyInput& input, const std::string& why, StrategyStep& out) {
  lists_.drop_unreachable(goal_);
  out.events.push_back({"unreachable", "position " + text(goal_) + ": " + why});
  out.activity = "giving up an unreachable position";
  begin_escape(input, out);
}

void PaperCoverage::begin_recovery(const StrategyInput& input, const Sectors& sectors, StrategyStep& out) {
  if (++recoveries_ > params_.max_recoveries) {
    if (after_recovery_ == State::kEscape) {
      give_up_escape(input, "the local planner finds no path", out);
    } else {
      begin_escape(input, out);
      trapped_ = state_ == State::kDone && lists().searched.size() <= 1;
    }
    return;
  }
  const double left = sectors[Sector::kLeft] + sectors[Sector::kLeftFront];
  const double right = sectors[Sector::kRight] + sectors[Sector::kRightFront];
  recovery_sign_ = left >= right ? 1.0 : -1.0;
  recovery_from_ = input.map_T_base;
  recovery_since_ = input.now;
  backing_ = true;
  state_ = State::kRecover;
  out.events.push_back({"recovery", "the path is blocked at " + text(input.map_T_base.translation()) + ", rotating"});
}

void PaperCoverage::recover(const StrategyInput& input, const Sectors& sectors, StrategyStep& out) {
  out.phase = "recover";
  if (backing_) {
    // A corner beside the robot forbids any motion forwards; the free direction is the one it came from.
    const bool far_enough = distance_m(input.map_T_base, recovery_from_) >= params_.recovery_back_m;
    if (!far_enough &&
        to_seconds(input.now - recovery_since_) < params_.recovery_back_m / kBackSpeed_m_s + kBackLag_s) {
      out.activity = "backing out";
      out.command.v_m_s = -kBackSpeed_m_s;
      return;
    }
    backing_ = false;
    recovery_since_ = input.now;
  }
  out.activity = "rotating to the side with more room";
  const double turned = std::abs(wrap_angle(input.map_T_base.theta_rad - recovery_from_.theta_rad));
  const bool clear = sectors[Sector::kFront] >= params_.recovery_clear_m && turned >= kMinRecoveryRotation_rad;
  if (clear || to_seconds(input.now - recovery_since_) > params_.recovery_rotation_s) {
    state_ = after_recovery_;
    progress_.go_on(input.now);
    motion_.start(input.map_T_base.translation(), input.now);
    return;
  }
  out.command.omega_rad_s = recovery_sign_ * params_.recovery_omega_rad_s;
}

void PaperCoverage::image_taken(const StrategyInput& input) {
  if (state_ == State::kLook) {
    begin_move(input);
  }
}

void PaperCoverage::interrupted(RobotTime now) {
  restart_ = true;
  progress_.start(now);
}

void PaperCoverage::transform(const MapMove& move) {
  lists_.transform(move);
  cell_ = move * cell_;
  goal_ = move * goal_;
}

}  // namespace seeker::search
