#include "server/search/map_coverage.hpp"

#include <algorithm>
#include <utility>

#include "common/core/text.hpp"

namespace seeker::search {
namespace {

constexpr double kRotationOmega_rad_s = 0.5;
constexpr double kRotationTime_s = 3.0;
/// Together a bit more than a full rotation.
constexpr int kMaxRotations = 5;
/// Share of a cell's reachable floor that must be covered before it counts as searched.
constexpr double kSearchedShare = 0.8;
/// The next goal is chosen so long before the robot would brake for the present one.
constexpr double kPlanAhead_s = 0.3;

}  // namespace

MapCoverage::MapCoverage(const PlanParams& params, std::unique_ptr<GoalChooser> chooser)
    : params_(params), chooser_(std::move(chooser)), driver_(params.driver()), waits_(params.waits) {
  lists_.cell_size_m = params.cell_m;
}

StrategyStep MapCoverage::step(const StrategyInput& input) {
  StrategyStep out;
  for (const Point2& cell : std::exchange(new_cells_, {})) {
    out.events.push_back({"cell_searched", "searched cell " + text(cell)});
  }
  switch (state_) {
    case State::kChoose: choose(input, out); break;
    case State::kDrive: drive(input, out); break;
    case State::kLook:
      out.phase = "look";
      out.activity = "taking a picture at " + text(input.map_T_base.translation());
      out.wants_image = true;
      break;
    case State::kRotate: rotate(input, out); break;
    case State::kWait: wait(input, out); break;
    case State::kDone: break;
  }
  if (state_ == State::kDone) {
    out.done = true;
    out.trapped = trapped_;
    out.activity = cause_;
  }
  return out;
}

void MapCoverage::choose(const StrategyInput& input, StrategyStep& out) {
  const auto floor = input.floors.view(true);
  if (!floor) {
    begin_rotation(input, floor.error().message, out);
    return;
  }
  const auto costs = nav::DistanceField::build((*floor)->cost, input.map_T_base.translation());
  if (!costs) {
    begin_rotation(input, costs.error().message, out);
    return;
  }
  rotations_ = 0;
  const std::vector<Point2> avoid = avoided(input.now);
  goal_ = chooser_->choose(choice(input, **floor, *costs, avoid));
  if (!goal_) {
    nothing_left(input, **floor, *costs, out);
    return;
  }
  if (!driver_.start(input, goal_->p_map, goal_->heading_rad)) {
    fail_goal(driver_.failure(), input.now, out);
    return;
  }
  out.events.push_back({"goal", goal_->why + " " + text(goal_->p_map)});
  state_ = State::kDrive;
  planned_ahead_ = goes_on_ = false;
  drive(input, out);
}

ChooseInput MapCoverage::choice(const StrategyInput& input, const nav::FloorView& floor,
                                const nav::DistanceField& costs, const std::vector<Point2>& avoid) {
  return {floor, costs, input.evidence, input.map_T_base, input.target_size_m, avoid, input.map_views};
}

void MapCoverage::begin_rotation(const StrategyInput& input, const std::string& why, StrategyStep& out) {
  if (++rotations_ > kMaxRotations) {
    if (wait_enclosed(input, out)) {
      return;
    }
    state_ = State::kDone;
    trapped_ = true;
    cause_ = why;
    return;
  }
  state_ = State::kRotate;
  rotation_since_ = input.now;
  out.events.push_back({"recovery", "rotating to see more: " + why});
  out.activity = "rotating to see more";
}

void MapCoverage::rotate(const StrategyInput& input, StrategyStep& out) {
  out.phase = "recover";
  out.activity = "rotating to see more";
  if (to_seconds(input.now - rotation_since_) > kRotationTime_s) {
    state_ = State::kChoose;
    return;
  }
  out.command.omega_rad_s = kRotationOmega_rad_s;
}

bool MapCoverage::look_due(const StrategyInput& input) const {
  const double spacing_m = params_.look_while_moving ? params_.look_spacing_m : params_.stop_spacing_m;
  return !last_look_ || (input.map_T_base.translation() - *last_look_).norm() >= spacing_m;
}

/// Before the goal is reached, its picture is taken for granted: what the evidence will be decides where to go on.
void MapCoverage::plan_ahead(const StrategyInput& input, const nav::DriveStep& drive) {
  const bool due = !planned_ahead_ && params_.look_while_moving && !goal_->is_frontier;
  if (!due || !driver_.brakes_within(kPlanAhead_s, drive)) {
    return;
  }
  planned_ahead_ = true;
  const auto floor = input.floors.view();
  const auto costs = floor ? nav::DistanceField::build((*floor)->cost, goal_->p_map) : tl::unexpected(floor.error());
  if (!costs) {
    return;
  }
  const Pose2 map_T_there{goal_->p_map.x(), goal_->p_map.y(), input.map_T_base.theta_rad};
  EvidenceGrid evidence = input.evidence;
  evidence.add_look((*floor)->occupancy, goal_->p_map, input.target_size_m);
  const std::vector<Point2> avoid = avoided(input.now);
  const std::optional<Goal> next =
      chooser_->foresee({**floor, *costs, evidence, map_T_there, input.target_size_m, avoid, input.map_views});
  goes_on_ = next && driver_.go_on(input, next->p_map, next->heading_rad);
}

void MapCoverage::drive(const StrategyInput& input, StrategyStep& out) {
  const nav::DriveStep drive = driver_.step(input);
  out.command = drive.command;
  out.planned_path = driver_.path();
  out.activity = "going to " + goal_->why + " " + text(goal_->p_map);
  switch (drive.state) {
    case nav::DriveState::kDriving:
      plan_ahead(input, drive);
      if (look_due(input) || passes_goal()) {
        out.wants_image = true;
        out.while_moving = params_.look_while_moving;
      }
      break;
    case nav::DriveState::kArrived:
      chooser_->visited(*goal_, input.map_T_base);
      waits_.reset();
      state_ = State::kLook;
      break;
    case nav::DriveState::kFailed:
    case nav::DriveState::kIdle: fail_goal({drive.cause, drive.reason}, input.now, out); break;
  }
}

void MapCoverage::fail_goal(const nav::DriveFailure& why, RobotTime now, StrategyStep& out) {
  auto place = std::find_if(failed_.begin(), failed_.end(), [&](const Failed& one) {
    return (one.p_map - goal_->p_map).norm() < params_.failed_radius_m;
  });
  place = place == failed_.end() ? failed_.insert(place, Failed{goal_->p_map, 0, now}) : place;
  place->last = now;
  place->place = {goal_->p_map, why.cause, goal_->size_m, why.text};
  const bool given_up = ++place->times >= params_.max_failures;
  list_unreachable();
  out.events.push_back(
      {given_up ? "unreachable" : "goal_failed", goal_->why + " " + text(goal_->p_map) + ": " + why.text});
  out.activity = given_up ? "giving up an unreachable goal" : "leaving a goal for later";
  goal_.reset();
  driver_.stop();
  state_ = State::kChoose;
}

std::vector<Point2> MapCoverage::avoided(RobotTime now) const {
  std::vector<Point2> places;
  for (const Failed& one : failed_) {
    if (one.times >= params_.max_failures || to_seconds(now - one.last) < params_.retry_s) {
      places.push_back(one.p_map);
    }
  }
  return places;
}

void MapCoverage::list_unreachable() {
  lists_.unreachable.clear();
  for (const Failed& one : failed_) {
    if (one.times >= params_.max_failures) {
      lists_.unreachable.push_back(one.p_map);
    }
  }
}

std::vector<UnreachablePlace> MapCoverage::unreachable() const {
  std::vector<UnreachablePlace> places;
  for (const Failed& one : failed_) {
    if (one.times >= params_.max_failures) {
      places.push_back(one.place);
      places.back().p_map = one.p_map;
    }
  }
  return places;
}

void MapCoverage::image_taken(const StrategyInput& input) {
  last_look_ = input.map_T_base.translation();
  update_lists(input);
  if (state_ == State::kLook) {
    state_ = State::kChoose;
    return;
  }
  if (state_ == State::kDrive && passes_goal()) {
    chooser_->visited(*goal_, input.map_T_base);
    waits_.reset();
    state_ = State::kChoose;
    return;
  }
  const auto floor = input.floors.view();
  if (state_ == State::kDrive && floor &&
      !chooser_->still_worth(*goal_, **floor, input.evidence, input.target_size_m)) {
    state_ = State::kChoose;
  }
}

void MapCoverage::update_lists(const StrategyInput& input) {
  const auto floor = input.floors.view();
  if (!floor) {
    return;
  }
  const Grid<std::uint8_t>& reachable = (*floor)->reachable;
  const GridFrame frame{Point2::Zero(), params_.cell_m};
  std::map<CellIndex, std::pair<int, int>> cells;  // of each cell: floor, covered
  for (std::size_t k = 0; k < reachable.cells().size(); ++k) {
    if (reachable.cells()[k] != 0) {
      const Point2 p = reachable.frame().centre_of(reachable.cell(k));
      auto& [total, covered] = cells[frame.cell_of(p)];
      ++total;
      covered += input.evidence.probability_at(p) >= input.evidence.params().threshold ? 1 : 0;
    }
  }
  lists_.unsearched.clear();
  for (const auto& [cell, counts] : cells) {
    const auto& [total, covered] = counts;
    if (searched_cells_.contains(cell)) {
      continue;
    }
    if (covered >= kSearchedShare * total) {
      searched_cells_.insert(cell);
      lists_.searched.push_back(frame.centre_of(cell));
      new_cells_.push_back(frame.centre_of(cell));
    } else {
      lists_.unsearched.push_back(frame.centre_of(cell));
    }
  }
}

void MapCoverage::interrupted(RobotTime /*now*/) {
  driver_.stop();
  if (state_ == State::kDrive || state_ == State::kRotate) {
    state_ = State::kChoose;
  }
}

void MapCoverage::transform(const MapMove& move) {
  chooser_->transform(move);
  for (auto* list : {&lists_.searched, &lists_.unsearched, &lists_.unreachable}) {
    for (Point2& p : *list) {
      p = move * p;
    }
  }
  note_searched_cells();
  for (Failed& one : failed_) {
    one.p_map = move * one.p_map;
  }
  waits_.transform(move);
  if (last_look_) {
    last_look_ = move * *last_look_;
  }
  driver_.stop();
  if (state_ == State::kDrive) {
    state_ = State::kChoose;
  }
}

void MapCoverage::take_back(const GridLists& lists) {
  if (lists.cell_size_m == params_.cell_m) {
    lists_.searched = lists.searched;
    lists_.unsearched = lists.unsearched;
    note_searched_cells();
  }
}

void MapCoverage::note_searched_cells() {
  const GridFrame frame{Point2::Zero(), params_.cell_m};
  searched_cells_.clear();
  for (const Point2& p : lists_.searched) {
    searched_cells_.insert(frame.cell_of(p));
  }
}

}  // namespace seeker::search
