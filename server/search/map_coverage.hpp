/// \file
/// Coverage over the map: choose a goal, drive there, look, again, until no goal is left.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "server/nav/planned_driver.hpp"
#include "server/search/goal_chooser.hpp"
#include "server/search/strategy.hpp"

namespace seeker::search {

/// Pictures are taken at every goal and every look_spacing_m on the way. Without a usable map (start, or a wall of
/// noise around the robot) it turns on the spot to let the sensors see, and ends as trapped when that does not help.
/// Lists: cells of 0.8 m of the reachable floor; searched when at least 80 % of the cell's floor is covered.
class MapCoverage final : public CoverageStrategy {
 public:
  MapCoverage(const PlanParams& params, std::unique_ptr<GoalChooser> chooser);

  [[nodiscard]] StrategyStep step(const StrategyInput& input) override;
  void image_taken(const StrategyInput& input) override;
  void interrupted(RobotTime now) override;
  void transform(const Pose2& new_T_old) override;
  [[nodiscard]] const GridLists& lists() const override { return lists_; }

 private:
  enum class State : std::uint8_t { kChoose, kDrive, kLook, kTurn, kDone };

  void choose(const StrategyInput& input, StrategyStep& out);
  void begin_turn(const StrategyInput& input, const std::string& why, StrategyStep& out);
  void turn(const StrategyInput& input, StrategyStep& out);
  void drive(const StrategyInput& input, StrategyStep& out);
  void fail_goal(const std::string& why, StrategyStep& out);
  void update_lists(const StrategyInput& input);
  [[nodiscard]] bool look_due(const StrategyInput& input) const;

  PlanParams params_;
  std::unique_ptr<GoalChooser> chooser_;
  nav::PlannedDriver driver_;
  State state_ = State::kLook;  ///< the first thing to do is to look around
  std::optional<Goal> goal_;
  std::optional<Point2> last_look_;
  RobotTime turn_since_;
  int turns_ = 0;
  bool trapped_ = false;
  std::string cause_;
  GridLists lists_;
  std::set<CellIndex> searched_cells_;
  std::vector<Point2> new_cells_;  ///< searched since the last step, for events
};

}  // namespace seeker::search
