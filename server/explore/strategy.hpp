/// \file
/// What leads the robot through a building nobody has mapped: one interface for the paper's rule, the planner that
/// looks farther, and the baselines.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/core/explore_decision.hpp"
#include "common/core/line_map.hpp"
#include "common/core/map_move.hpp"
#include "common/core/topology.hpp"
#include "server/nav/planned_driver.hpp"
#include "server/slam/map_tracker.hpp"

namespace seeker::explore {

/// `now` is the exploration's own time: it stands still while it is paused.
struct StrategyInput : nav::DriveInput {
  Twist2 velocity;
  Matrix3 covariance = Matrix3::Zero();     ///< of (x, y, theta), frame `map`
  const std::vector<MapSegment>& segments;  ///< of the whole map, frame `map`
  std::uint64_t segments_revision = 0;      ///< rises with every change of `segments`
  std::optional<slam::LocalBelief> belief;  ///< the filter behind the newest of them; nothing: the estimator has none
  const FleetView* fleet = nullptr;         ///< other robots, frame `map`; null: the robot is alone
};

struct StrategyStep {
  Twist2 command;
  std::string phase;                 ///< "explore", "wall", "drive", "turn"
  std::string activity;              ///< what the robot does and why, one sentence
  std::vector<Point2> planned_path;  ///< frame `map`
  std::optional<ExploreDecision>
      decision;                     ///< present in the step that decided; number and stamp are filled in by the caller
  bool step_done = false;           ///< a natural place to stop
  bool done = false;                ///< nothing is left that this strategy could explore
  std::vector<Point2> unreachable;  ///< of done: places left that no way leads to
  bool tries_again = false;         ///< of done: whether try_again() would have it drive to those once more
};

class ExploreStrategy {
 public:
  ExploreStrategy() = default;
  ExploreStrategy(const ExploreStrategy&) = delete;
  ExploreStrategy& operator=(const ExploreStrategy&) = delete;
  virtual ~ExploreStrategy() = default;

  [[nodiscard]] virtual StrategyStep step(const StrategyInput& input) = 0;
  /// Something else moved the robot, or time passed: present drives are void, and one that was done looks again.
  virtual void interrupted(RobotTime now) = 0;
  /// Interrupted to give whoever stood in the way time to go on: what was given up may be tried once more.
  virtual void try_again(RobotTime now) { interrupted(now); }
  /// The map moved: `move` takes places of the map before to the map now.
  virtual void transform(const MapMove& move) = 0;
  /// Places it has been at and still means to go to; null where the strategy keeps none.
  [[nodiscard]] virtual const Topology* topology() const { return nullptr; }
  /// What it must know again to go on after the program was cut off; nothing where all of it is seen from the map.
  [[nodiscard]] virtual std::optional<TopologyMemory> memory() const { return std::nullopt; }
  /// Before the first step: goes on from there.
  virtual void remember(const TopologyMemory& /*memory*/) {}
  /// The goal it drives to, of those in its topology.
  [[nodiscard]] virtual std::optional<Point2> target_map() const { return std::nullopt; }
};

struct ExploreParams;
/// Makes a strategy of numbers that have been validated; never null. Whoever composes an exploration chooses it, so
/// that strategies may live in folders that this one knows nothing of.
using StrategyMaker = std::function<std::unique_ptr<ExploreStrategy>(const ExploreParams&)>;

/// The strategies of this folder.
/// active: one step of the objective, out of traps along walls, then by paths (spec S1.11, S1.12).
/// horizon: reachable viewpoints over several drives, same objective.
/// roam, frontier, gain: the baselines.
enum class Strategy : std::uint8_t { kActive, kHorizon, kRoam, kFrontier, kGain };

[[nodiscard]] std::string_view to_string(Strategy strategy);

}  // namespace seeker::explore
