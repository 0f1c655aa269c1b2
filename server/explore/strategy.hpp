/// \file
/// Strategies that lead the robot through an unmapped building: one interface for the paper's rule, the planner over
/// several drives, and the baselines.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/core/explore_decision.hpp"
#include "common/core/line_map.hpp"
#include "common/core/map_move.hpp"
#include "common/core/topology.hpp"
#include "common/core/unreachable.hpp"
#include "server/nav/planned_driver.hpp"
#include "server/slam/map_tracker.hpp"

namespace seeker::explore {

class Trail;

/// The inputs of one step of a strategy. `now` is the exploration's own time, which stands still while it is paused.
struct StrategyInput : nav::DriveInput {
  Twist2 velocity;
  Matrix3 covariance = Matrix3::Zero();     ///< covariance of (x, y, theta), frame `map`
  const std::vector<MapSegment>& segments;  ///< segments of the whole map, frame `map`
  std::uint64_t segments_revision = 0;      ///< rises with every change of `segments`
  /// The filter that made the newest segments; nothing: the estimator has none.
  std::optional<slam::LocalBelief> belief;
  const FleetView* fleet = nullptr;  ///< other robots, frame `map`; null: the robot is alone
  /// Where the robot drives once nothing is left to explore, frame `map`; nothing: it stays where it is then.
  std::optional<Point2> end_map = std::nullopt;
  const Trail* trail = nullptr;  ///< where the robot was during this exploration, and how certain; null: not recorded

  /// Sides of walls that other robots have mapped, frame `map`.
  [[nodiscard]] std::span<const MappedSide> others_sides() const {
    return fleet != nullptr && fleet->sides != nullptr ? std::span<const MappedSide>(*fleet->sides)
                                                       : std::span<const MappedSide>();
  }
};

struct StrategyStep {
  Twist2 command;
  std::string phase;                 ///< "explore", "wall", "drive", "turn", "wait"
  std::string activity;              ///< what the robot does and why, in one sentence
  std::vector<Point2> planned_path;  ///< frame `map`
  std::optional<ExploreDecision>
      decision;            ///< present in the step that decided; number and stamp are filled in by the caller
  bool step_done = false;  ///< whether the robot is at a natural place to stop
  bool done = false;       ///< whether the strategy finds nothing more to explore
  std::vector<UnreachablePlace> unreachable;  ///< with done: places that no path leads to
  /// With done: openings that the strategy left because they are too small to drive to, frame `map`.
  std::vector<Point2> left_map;
  bool tries_again = false;  ///< with done: whether try_again() would make it drive to those once more
};

class ExploreStrategy {
 public:
  ExploreStrategy() = default;
  ExploreStrategy(const ExploreStrategy&) = delete;
  ExploreStrategy& operator=(const ExploreStrategy&) = delete;
  virtual ~ExploreStrategy() = default;

  [[nodiscard]] virtual StrategyStep step(const StrategyInput& input) = 0;
  /// Another behaviour moved the robot, or time passed: present drives are dropped, and a finished strategy searches
  /// for openings again.
  virtual void interrupted(RobotTime now) = 0;
  /// Called after a wait that gave people time to clear the path: openings that were given up may be tried once more.
  virtual void try_again(RobotTime now) { interrupted(now); }
  /// The map was corrected: `move` takes places of the previous map to the present one.
  virtual void transform(const MapMove& move) = 0;
  /// Places that the robot has visited and places that it plans to visit; null where the strategy keeps none.
  [[nodiscard]] virtual const Topology* topology() const { return nullptr; }
  /// What the strategy must restore to continue after an interruption of the program. Nothing: the map holds all of it.
  [[nodiscard]] virtual std::optional<TopologyMemory> memory() const { return std::nullopt; }
  /// Continues from a restored state. Call it before the first step.
  virtual void remember(const TopologyMemory& /*memory*/) {}
  /// The goal of the present drive; of a strategy that keeps a topology one of those in it.
  [[nodiscard]] virtual std::optional<Point2> target_map() const { return std::nullopt; }
  /// Whether it leaves to other robots what is their share of the exploration, and expects the same of them.
  [[nodiscard]] virtual bool shares() const { return topology() != nullptr; }
};

struct ExploreParams;
/// Makes a strategy from validated parameters; never null. The code that composes an exploration chooses it, so that
/// strategies may live in folders that this one does not know.
using StrategyMaker = std::function<std::unique_ptr<ExploreStrategy>(const ExploreParams&)>;

/// The strategies of this folder.
/// active: one step of the objective, out of traps along walls, then by paths (spec S1.11, S1.12).
/// horizon: reachable viewpoints over several drives, same objective; what an exploration uses that names none.
/// tour: a tour over all still to be seen: in offices a sixth shorter than frontier, in small buildings not.
/// roam, frontier, gain: the baselines.
enum class Strategy : std::uint8_t { kActive, kHorizon, kTour, kRoam, kFrontier, kGain };

[[nodiscard]] std::string_view to_string(Strategy strategy);

}  // namespace seeker::explore
