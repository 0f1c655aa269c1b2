#include "server/search/drive_to.hpp"

#include <utility>

namespace seeker::search {

DriveTo::DriveTo(const SearchParams& params, LocalPlanner planner, bool use_map)
    : paper_(params.paper), planner_(std::move(planner)), driver_(params.plan.driver()), use_map_(use_map) {}

bool DriveTo::start(const StrategyInput& input, const Point2& goal_map, double tolerance_m) {
  goal_ = goal_map;
  tolerance_m_ = tolerance_m;
  progress_.start(input.now);
  active_ = !use_map_ || driver_.start(input, goal_map);
  return active_;
}

void DriveTo::stop() {
  active_ = false;
  driver_.stop();
}

std::vector<Point2> DriveTo::path(const Pose2& map_T_base) const {
  if (!active_) {
    return {};
  }
  return use_map_ ? driver_.path() : std::vector<Point2>{map_T_base.translation(), goal_};
}

nav::DriveStep DriveTo::step(const StrategyInput& input) {
  if (!active_) {
    return {};
  }
  nav::DriveStep out = use_map_ ? driver_.step(input) : step_locally(input);
  active_ = out.state == nav::DriveState::kDriving;
  return out;
}

nav::DriveStep DriveTo::step_locally(const StrategyInput& input) {
  const double remaining = (goal_ - input.map_T_base.translation()).norm();
  if (remaining <= tolerance_m_) {
    return {{}, nav::DriveState::kArrived, {}};
  }
  if (progress_.idle_s(remaining, paper_.progress_m, input.now) > paper_.progress_time_s) {
    return {{}, nav::DriveState::kFailed, "no progress"};
  }
  const auto sectors = planner_.sense(input.sonar, input.map_T_base, input.now);
  if (!sectors) {
    return {{}, nav::DriveState::kFailed, sectors.error().message};
  }
  const auto command = planner_.drive(*sectors, bearing_to(input.map_T_base, goal_));
  if (!command) {
    return {{}, nav::DriveState::kFailed, command.error().message};
  }
  return {*command, nav::DriveState::kDriving, {}};
}

}  // namespace seeker::search
