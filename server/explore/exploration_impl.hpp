/// \file
/// Inside of Exploration; nobody else includes it.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/explore/blocked_ways.hpp"
#include "server/explore/exploration.hpp"
#include "server/explore/trail.hpp"
#include "server/nav/known_floor.hpp"
#include "server/nav/retry_drive.hpp"
#include "server/nav/sonar_obstacles.hpp"
#include "server/nav/wait_turns.hpp"

namespace seeker::explore {

/// The floor grew by so much since: waiting, or going back to where the robot knows its place, had a use.
inline constexpr double kNewFloor_m2 = 2.0;

class Exploration::Impl {
 public:
  Impl(const ExploreRequest& request, const ExploreParams& params, std::unique_ptr<ExploreStrategy> strategy);

  [[nodiscard]] ExploreStep step(const ExploreInput& input);
  void resume(RobotTime now);
  void transform(const MapMove& move);
  [[nodiscard]] const std::optional<ExploreEnd>& pending_end() const { return pending_end_; }
  void remember(const TopologyMemory& memory) { strategy_->remember(memory); }
  void remember_start(const Point2& start_map) { start_ = start_map; }
  [[nodiscard]] const ExploreStrategy& strategy() const { return *strategy_; }

 private:
  enum class Mode : std::uint8_t { kExplore, kRegain, kReturn };

  [[nodiscard]] StrategyInput strategy_input(const ExploreInput& input);
  [[nodiscard]] std::string cause_to_stand(const ExploreInput& input) const;
  void stand(const ExploreInput& input, const std::string& why, ExploreStep& out);
  void begin(const ExploreInput& input);
  void act(const ExploreInput& input, ExploreStep& out);

  void explore(const StrategyInput& input, ExploreStep& out);
  void hand_over(StrategyStep&& from, ExploreStep& out);
  void note_traps(const std::string& phase, const std::string& activity, ExploreStep& out);

  // exploration_guard.cpp
  void check_battery(const ExploreInput& input, ExploreStep& out);
  void check_time(const ExploreInput& input, ExploreStep& out);
  [[nodiscard]] double way_home_m(const Point2& here_map);
  void check_certainty(const StrategyInput& input, double sigma_m, ExploreStep& out);
  void begin_regain(const StrategyInput& input, double sigma_m, ExploreStep& out);
  void regain(const StrategyInput& input, double sigma_m, ExploreStep& out);
  void go_home(const StrategyInput& input, ExploreStep& out);

  // exploration_wait.cpp
  void begin_wait(const nav::WaitTurn& turn, const StrategyInput& input, ExploreStep& out);
  [[nodiscard]] bool waits(const StrategyInput& input, ExploreStep& out);
  void strategy_done(const StrategyStep& last, const StrategyInput& input, ExploreStep& out);

  // exploration_end.cpp
  /// What keeps it from being complete, as the map shows it now.
  struct Left {
    std::optional<Error> no_floor;           ///< the robot stands walled in, or there is no map
    std::vector<nav::BlockedPlace> cut_off;  ///< floor that was seen, but no way leads there
    BlockedWays people;                      ///< who stands in a way, and what lies behind
    bool beyond_limits = false;
  };
  [[nodiscard]] bool was_reachable(const CutOffFloor& part, const GridFrame& frame) const;
  [[nodiscard]] Left what_is_left(const StrategyInput& input);
  [[nodiscard]] ExploreEnd end_for(const Left& left, const StrategyStep& last, const Point2& here_map) const;
  void conclude(ExploreEnd end, RobotTime now, ExploreStep& out);
  void measure_progress(const StrategyInput& input);

  ExploreRequest request_;
  ExploreParams params_;
  std::unique_ptr<ExploreStrategy> strategy_;
  nav::FloorSource floors_;
  nav::SonarObstacles sonar_obstacles_;
  Trail trail_;
  Mode mode_ = Mode::kExplore;

  nav::RetryDrive home_;
  std::optional<Point2> start_;
  std::optional<ExploreEnd> pending_end_;  ///< of kReturn: what will be reported on arrival
  std::optional<ExploreEnd> end_;

  nav::RetryDrive back_;         ///< of kRegain
  std::deque<Point2> back_way_;  ///< of kRegain: places still to go to
  bool back_driving_ = false;    ///< towards the first of them
  RobotTime got_back_;           ///< of kRegain: when the last of the places was reached, or it began
  int fruitless_regains_ = 0;    ///< in a row, without new floor in between
  double floor_at_regain_m2_ = 0.0;

  nav::KnownFloor known_floor_;
  nav::PlannedDriver lookout_;              ///< to where one sees whether the way is free again
  std::optional<RobotTime> waiting_since_;  ///< for somebody to move out of the way
  nav::WaitTurns turns_;                    ///< since new floor was seen
  double floor_at_wait_m2_ = 0.0;

  std::optional<RobotTime> battery_low_since_;
  bool battery_checked_ = true;  ///< false after the battery has sent the robot home
  std::optional<RobotTime> time_checked_at_;
  bool standing_ = false;  ///< waiting for a pose or a scan
  RobotTime lost_since_;
  std::string last_phase_;
  std::uint64_t decisions_ = 0;
  double progress_ = 0.0;
  std::optional<RobotTime> measured_at_;
  std::optional<RobotTime> last_now_;
  Duration paused_{0};
};

}  // namespace seeker::explore
