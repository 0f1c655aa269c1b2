/// \file
/// The coverage algorithm as printed (spec S3.3, steps 1-4), with sonars and bearings only.
#pragma once

#include "server/nav/progress_watch.hpp"
#include "server/search/coverage_lists.hpp"
#include "server/search/local_planner.hpp"
#include "server/search/search_params.hpp"
#include "server/search/strategy.hpp"

namespace seeker::search {

/// Steps 1-4 as a state machine. Decisions that the paper leaves open:
/// - Recognition also runs where an escape (step 3) arrives, because that place is new too.
/// - Forbidden areas are walls for the sonars' sectors; potential cells in them are not appended.
/// - When the fuzzy planner makes no progress (less than stuck_move_m in stuck_time_s, for example because it
///   oscillates between two equal directions), the robot rotates on the spot to the side with more room until the front
///   is clear, at most max_recoveries times in a row. Then the goal of an escape is dropped as unreachable, and a step
///   4 becomes an escape (step 3).
class PaperCoverage final : public CoverageStrategy {
 public:
  PaperCoverage(const PaperParams& params, LocalPlanner planner, nav::ForbiddenAreas areas);

  [[nodiscard]] StrategyStep step(const StrategyInput& input) override;
  void image_taken(const StrategyInput& input) override;
  void interrupted(RobotTime now) override;
  void transform(const MapMove& move) override;
  void take_back(const GridLists& lists) override { lists_.take_back(lists); }
  [[nodiscard]] const GridLists& lists() const override { return lists_.lists(); }

 private:
  enum class State : std::uint8_t { kArrive, kLook, kMove, kEscape, kRecover, kDone };

  void arrive(const StrategyInput& input, const Sectors& sectors, StrategyStep& out);
  void note_potential_cells(const StrategyInput& input, const Sectors& sectors, StrategyStep& out);
  void begin_move(const StrategyInput& input);
  void begin_escape(const StrategyInput& input, StrategyStep& out);
  void move(const StrategyInput& input, const Sectors& sectors, StrategyStep& out);
  void escape(const StrategyInput& input, const Sectors& sectors, StrategyStep& out);
  void give_up_escape(const StrategyInput& input, const std::string& why, StrategyStep& out);
  void begin_recovery(const StrategyInput& input, const Sectors& sectors, StrategyStep& out);
  void recover(const StrategyInput& input, const Sectors& sectors, StrategyStep& out);
  void follow(const Sectors& sectors, double target_rad, StrategyStep& out);
  [[nodiscard]] bool stuck(const StrategyInput& input);

  PaperParams params_;
  LocalPlanner planner_;
  nav::ForbiddenAreas areas_;
  CoverageLists lists_;
  State state_ = State::kArrive;
  State after_recovery_ = State::kMove;
  Point2 cell_ = Point2::Zero();  ///< P_i, frame `map`
  Point2 goal_ = Point2::Zero();  ///< goal of an escape, frame `map`
  nav::ProgressWatch progress_;
  nav::MotionWatch motion_;
  RobotTime recovery_since_;
  double recovery_sign_ = 1.0;
  Pose2 recovery_from_;
  bool backing_ = false;
  int recoveries_ = 0;
  bool restart_ = true;  ///< the progress watches start again with the next step
  bool blind_ = false;
  bool trapped_ = false;
};

}  // namespace seeker::search
