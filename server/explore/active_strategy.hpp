/// \file
/// Exploration by the rule of the active-SLAM paper: steps by the objective, wall following to leave local traps (spec
/// S1.11, S1.12), and beyond the paper, planned paths to the remaining openings when no wall leads on.
#pragma once

#include <string>
#include <vector>

#include "server/explore/control_hold.hpp"
#include "server/explore/look_round.hpp"
#include "server/explore/one_step.hpp"
#include "server/explore/place_strategy.hpp"
#include "server/explore/trap_watch.hpp"
#include "server/explore/wall_follower.hpp"

namespace seeker::explore {

class ActiveStrategy final : public ExploreStrategy {
 public:
  explicit ActiveStrategy(const ExploreParams& params);

  [[nodiscard]] StrategyStep step(const StrategyInput& input) override;
  void interrupted(RobotTime now) override;
  void try_again(RobotTime now) override;
  void transform(const MapMove& move) override;

 private:
  enum class Mode : std::uint8_t { kExplore, kWall, kPath, kDone };

  /// True while the robot still observes from its start before the first decision.
  [[nodiscard]] bool looks_first(RobotTime now);
  void decide(const StrategyInput& input, StrategyStep& out);
  void explore(const StrategyInput& input, const MapSize& size, StrategyStep& out);
  void begin_wall(const StrategyInput& input, const MapSize& size, StrategyStep& out);
  void follow_wall(const StrategyInput& input, const MapSize& size, StrategyStep& out);
  void begin_path(const StrategyInput& input, StrategyStep& out);
  void follow_path(const StrategyInput& input, StrategyStep& out);
  void give_end_up(const std::optional<Point2>& p_map);
  /// The segments, with those ends marked as real that were found to lead nowhere.
  [[nodiscard]] std::vector<MapSegment> believed(const std::vector<MapSegment>& segments) const;

  ExploreParams params_;
  ControlHold hold_;
  TrapWatch watch_;
  LookRound look_round_;
  WallFollower follower_;
  PlaceStrategy path_;
  std::optional<RobotTime> began_;
  Mode mode_ = Mode::kExplore;
  std::string why_;
  std::vector<Point2> closed_map_;  ///< ends of walls that led nowhere, frame `map`
  std::optional<Point2> wall_goal_map_;
  RobotTime wall_since_;
  MapSize wall_size_;  ///< size of the largest map so far while following walls
};

}  // namespace seeker::explore
