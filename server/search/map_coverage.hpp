/// \file
/// Coverage over the map: choose a goal, drive there, take a picture, and repeat until no goal is left.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "server/nav/planned_driver.hpp"
#include "server/nav/wait_schedule.hpp"
#include "server/search/goal_chooser.hpp"
#include "server/search/strategy.hpp"

namespace seeker::search {

/// Takes pictures at every goal and every look_spacing_m while driving. A robot that takes pictures while it moves
/// plans on from a goal before it arrives, and drives through; what it sees there decides where it really goes. Without
/// a usable map (at the start, or with noise around the robot) it rotates on the spot so that the sensors can observe,
/// and ends as trapped when that does not help. A goal that could not be reached rests for a while. When no other goal
/// is left, the robot waits at blocked paths that led on before, and tries the unreached goals once more, before it
/// ends. Lists: cells of 0.8 m of the reachable floor, searched when at least 80 % of the cell's floor is covered.
class MapCoverage final : public CoverageStrategy {
 public:
  MapCoverage(const PlanParams& params, std::unique_ptr<GoalChooser> chooser);

  [[nodiscard]] StrategyStep step(const StrategyInput& input) override;
  void image_taken(const StrategyInput& input) override;
  void interrupted(RobotTime now) override;
  void transform(const MapMove& move) override;
  /// Places that could not be reached are tried again.
  void take_back(const GridLists& lists) override;
  [[nodiscard]] const GridLists& lists() const override { return lists_; }
  [[nodiscard]] std::vector<UnreachablePlace> unreachable() const override;

 private:
  enum class State : std::uint8_t { kChoose, kDrive, kLook, kRotate, kWait, kDone };

  void choose(const StrategyInput& input, StrategyStep& out);
  /// The inputs of a choice; the result keeps references to all arguments.
  [[nodiscard]] static ChooseInput choice(const StrategyInput& input, const nav::FloorView& floor,
                                          const nav::DistanceField& costs, const std::vector<Point2>& avoid);
  void begin_rotation(const StrategyInput& input, const std::string& why, StrategyStep& out);
  void rotate(const StrategyInput& input, StrategyStep& out);
  void drive(const StrategyInput& input, StrategyStep& out);
  /// Chooses the goal behind the present one before the robot would brake for this one, so that it drives through.
  void plan_ahead(const StrategyInput& input, const nav::DriveStep& drive);
  /// Whether the robot drives through its goal now: the picture there is due.
  [[nodiscard]] bool passes_goal() const { return goes_on_ && !driver_.passes_through(); }
  void fail_goal(const nav::DriveFailure& why, RobotTime now, StrategyStep& out);
  /// Places near which no goal may be chosen now.
  [[nodiscard]] std::vector<Point2> avoided(RobotTime now) const;
  void list_unreachable();

  // map_coverage_wait.cpp
  void nothing_left(const StrategyInput& input, const nav::FloorView& floor, const nav::DistanceField& costs,
                    StrategyStep& out);
  void begin_wait(const nav::PlannedWait& planned, const StrategyInput& input, const nav::FloorView& floor,
                  const nav::DistanceField& costs, StrategyStep& out);
  /// Waits where the robot is held, if it drove there: who holds it may go on. False when it has waited enough.
  [[nodiscard]] bool wait_enclosed(const StrategyInput& input, StrategyStep& out);
  void stand_waiting(std::string what, const StrategyInput& input, StrategyStep& out);
  void wait(const StrategyInput& input, StrategyStep& out);
  void update_lists(const StrategyInput& input);
  void note_searched_cells();
  [[nodiscard]] bool look_due(const StrategyInput& input) const;

  /// Failed drives to about this place since the robot last waited there.
  struct Failed {
    Point2 p_map;
    int times = 0;
    RobotTime last;
    UnreachablePlace place = {};  ///< as it failed last; its position is p_map
  };

  PlanParams params_;
  std::unique_ptr<GoalChooser> chooser_;
  nav::PlannedDriver driver_;
  State state_ = State::kLook;  ///< the first action is to take a picture
  std::optional<Goal> goal_;
  bool planned_ahead_ = false;  ///< the goal behind this one was looked for
  bool goes_on_ = false;        ///< the path leads through the goal to one behind it
  std::optional<Point2> last_look_;
  RobotTime rotation_since_;
  int rotations_ = 0;
  std::vector<Failed> failed_;
  nav::WaitSchedule waits_;
  RobotTime waiting_since_;
  bool trapped_ = false;
  std::string cause_;
  GridLists lists_;
  std::set<CellIndex> searched_cells_;
  std::vector<Point2> new_cells_;  ///< cells searched since the last step, for events
};

}  // namespace seeker::search
