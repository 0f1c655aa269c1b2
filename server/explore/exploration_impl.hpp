/// \file
/// Implementation of Exploration; no other file includes it.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/explore/blocked_paths.hpp"
#include "server/explore/exploration.hpp"
#include "server/explore/trail.hpp"
#include "server/nav/frontiers.hpp"
#include "server/nav/known_floor.hpp"
#include "server/nav/retry_drive.hpp"
#include "server/nav/sonar_obstacles.hpp"
#include "server/nav/wait_schedule.hpp"

namespace seeker::explore {

/// Growth of the known floor, in square metres, after which waiting or a return to a certain place counts as
/// successful.
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
  enum class Mode : std::uint8_t { kExplore, kRegain, kReturn, kMakeRoom };

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
  [[nodiscard]] double return_length_m(const Point2& here_map);
  void check_certainty(const StrategyInput& input, double sigma_m, ExploreStep& out);
  void begin_regain(const StrategyInput& input, double sigma_m, ExploreStep& out);
  void regain(const StrategyInput& input, double sigma_m, ExploreStep& out);
  /// That of kReturn and kMakeRoom, after which the exploration ends.
  void last_drive(const StrategyInput& input, ExploreStep& out);
  void name_last_drive(ExploreStep& out) const;

  // exploration_wait.cpp
  void begin_wait(const nav::PlannedWait& planned, const StrategyInput& input, ExploreStep& out);
  [[nodiscard]] bool waits(const StrategyInput& input, ExploreStep& out);
  void strategy_done(const StrategyStep& last, const StrategyInput& input, ExploreStep& out);

  // exploration_end.cpp
  /// What prevents the exploration from being complete, according to the present map.
  struct Left {
    std::optional<Error> no_floor;                 ///< set when the robot is enclosed by obstacles or there is no map
    std::vector<nav::BlockedPlace> cut_off;        ///< floor that was observed but that no path leads to
    std::vector<UnreachablePlace> cut_off_places;  ///< the same, with its size
    std::vector<nav::Frontier> borders;            ///< of unknown floor: give the width of what a strategy leaves
    GridFrame frame;                               ///< of their cells
    BlockedPaths people;                           ///< people and objects that block a path, and the goals behind them
    bool beyond_limits = false;
  };
  [[nodiscard]] bool was_reachable(const CutOffFloor& part, const GridFrame& frame) const;
  [[nodiscard]] Left what_is_left(const StrategyInput& input);
  [[nodiscard]] ExploreEnd end_for(const Left& left, const StrategyStep& last, const Point2& here_map) const;
  /// Ends, after a drive to the start where it is to come back, or else to `room_map` where there is such a place.
  void conclude(ExploreEnd end, RobotTime now, ExploreStep& out, std::optional<Point2> room_map = std::nullopt);
  /// Where the robot does not keep others of its fleet from floor that they still explore; nothing: that is so here, or
  /// nobody explores.
  [[nodiscard]] std::optional<Point2> room_for_others(const StrategyInput& input);
  void measure_progress(const StrategyInput& input);

  ExploreRequest request_;
  ExploreParams params_;
  std::unique_ptr<ExploreStrategy> strategy_;
  nav::FloorSource floors_;
  nav::SonarObstacles sonar_obstacles_;
  Trail trail_;
  Mode mode_ = Mode::kExplore;

  nav::RetryDrive last_drive_;
  std::optional<Point2> start_;
  std::optional<ExploreEnd> pending_end_;  ///< during the last drive: the end that is reported on arrival
  std::optional<ExploreEnd> end_;

  nav::RetryDrive back_;            ///< drive of kRegain
  std::deque<Point2> regain_path_;  ///< places that kRegain still has to visit, frame `map`
  bool back_driving_ = false;       ///< whether the robot drives towards the first of them
  RobotTime got_back_;              ///< during kRegain: when the last place was reached, or when the mode began
  int fruitless_regains_ = 0;       ///< regains in a row without new floor in between
  double floor_at_regain_m2_ = 0.0;

  nav::KnownFloor known_floor_;
  nav::PlannedDriver lookout_;  ///< drive to a place from which the robot sees whether the path is free again
  std::optional<RobotTime> waiting_since_;  ///< since when the robot waits for a blocked path to become free
  nav::WaitSchedule wait_schedule_;         ///< waits since new floor was observed
  double floor_at_wait_m2_ = 0.0;

  std::optional<RobotTime> battery_low_since_;
  bool battery_checked_ = true;  ///< false after a low battery has ended the exploration
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
