/// \file
/// Coverage over the map: choose a goal, drive there, look, again, until no goal is left.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "server/nav/planned_driver.hpp"
#include "server/nav/wait_turns.hpp"
#include "server/search/goal_chooser.hpp"
#include "server/search/strategy.hpp"

namespace seeker::search {

/// Pictures are taken at every goal and every look_spacing_m on the way. Without a usable map (start, or a wall of
/// noise around the robot) it turns on the spot to let the sensors see, and ends as trapped when that does not help.
/// A goal that could not be reached rests for a while. When nothing else is left, the robot waits where a way is
/// blocked that led on before, and tries once more what it could not reach, before it ends. Lists: cells of 0.8 m of
/// the reachable floor; searched when at least 80 % of the cell's floor is covered.
class MapCoverage final : public CoverageStrategy {
 public:
  MapCoverage(const PlanParams& params, std::unique_ptr<GoalChooser> chooser);

  [[nodiscard]] StrategyStep step(const StrategyInput& input) override;
  void image_taken(const StrategyInput& input) override;
  void interrupted(RobotTime now) override;
  void transform(const MapMove& move) override;
  [[nodiscard]] const GridLists& lists() const override { return lists_; }

 private:
  enum class State : std::uint8_t { kChoose, kDrive, kLook, kTurn, kWait, kDone };

  void choose(const StrategyInput& input, StrategyStep& out);
  /// Keeps references to all of them.
  [[nodiscard]] static ChooseInput choice(const StrategyInput& input, const nav::FloorView& floor,
                                          const nav::DistanceField& costs, const std::vector<Point2>& avoid);
  void begin_turn(const StrategyInput& input, const std::string& why, StrategyStep& out);
  void turn(const StrategyInput& input, StrategyStep& out);
  void drive(const StrategyInput& input, StrategyStep& out);
  void fail_goal(const std::string& why, RobotTime now, StrategyStep& out);
  /// Goals near these are not to be chosen now.
  [[nodiscard]] std::vector<Point2> avoided(RobotTime now) const;
  void list_unreachable();

  // map_coverage_wait.cpp
  void nothing_left(const StrategyInput& input, const nav::FloorView& floor, const nav::DistanceField& costs,
                    StrategyStep& out);
  void begin_wait(const nav::WaitTurn& turn, const StrategyInput& input, const nav::FloorView& floor,
                  const nav::DistanceField& costs, StrategyStep& out);
  void wait(const StrategyInput& input, StrategyStep& out);
  void update_lists(const StrategyInput& input);
  [[nodiscard]] bool look_due(const StrategyInput& input) const;

  /// Drives to about this place that failed since it was last waited.
  struct Failed {
    Point2 p_map;
    int times = 0;
    RobotTime last;
  };

  PlanParams params_;
  std::unique_ptr<GoalChooser> chooser_;
  nav::PlannedDriver driver_;
  State state_ = State::kLook;  ///< the first thing to do is to look around
  std::optional<Goal> goal_;
  std::optional<Point2> last_look_;
  RobotTime turn_since_;
  int turns_ = 0;
  std::vector<Failed> failed_;
  nav::WaitTurns waits_;
  RobotTime waiting_since_;
  bool trapped_ = false;
  std::string cause_;
  GridLists lists_;
  std::set<CellIndex> searched_cells_;
  std::vector<Point2> new_cells_;  ///< searched since the last step, for events
};

}  // namespace seeker::search
