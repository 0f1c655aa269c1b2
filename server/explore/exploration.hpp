/// \file
/// A whole exploration: a strategy, the areas it may use, the conditions that send the robot back, and the end. It is
/// stepped by the robot loop and depends on its inputs alone.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/core/map_move.hpp"
#include "common/core/pose_estimate.hpp"
#include "common/core/result.hpp"
#include "server/explore/explore_params.hpp"
#include "server/explore/make_strategy.hpp"
#include "server/explore/strategy.hpp"

namespace seeker::explore {

struct ExploreRequest {
  StrategyMaker strategy = maker_of(Strategy::kTour);
  nav::ForbiddenAreas areas;     ///< frame `map`
  bool return_to_start = false;  ///< drive back to the pose of the first step before the time is up
};

/// The inputs of one control step. Pointers and references are valid during the call.
struct ExploreInput {
  RobotTime now;
  PoseEstimate pose;
  Twist2 velocity;
  const SonarScan* sonar = nullptr;
  const LaserScan* laser = nullptr;
  const nav::OccupancyMap& map;
  const std::vector<MapSegment>& segments;
  std::uint64_t segments_revision = 0;
  std::optional<slam::LocalBelief> belief;
  std::optional<double> battery_v;
  const FleetView* fleet = nullptr;     ///< other robots, frame `map`; null: the robot is alone
  std::vector<nav::Mover> movers = {};  ///< present poses of other robots, frame `map`
  /// Seconds until the exploration is ended from outside; nothing: no limit.
  std::optional<double> time_left_s = std::nullopt;
};

enum class EndKind : std::uint8_t {
  kComplete,      ///< no opening is left to explore
  kBoundReached,  ///< all remaining openings lie beyond the bound or in keep-out areas
  kUnreachable,   ///< places are left that no path leads to
  kUncertain,     ///< the position uncertainty could not be reduced below its limit
  kBattery,
  kTimeLimit,  ///< the remaining time was needed for the return to the start
};

struct ExploreEnd {
  EndKind kind = EndKind::kComplete;
  std::string cause;
  std::string remedy;
  std::vector<UnreachablePlace> unreachable;

  friend bool operator==(const ExploreEnd&, const ExploreEnd&) = default;
};

struct ExploreEvent {
  std::string kind;  ///< "trap", "escape", "uncertain", "certain", "battery", "time", "return", "unreachable"
  std::string text;

  friend bool operator==(const ExploreEvent&, const ExploreEvent&) = default;
};

struct ExploreStep {
  Twist2 command;
  std::string phase;  ///< the strategy's phase, or "wait", "regain", "return", "stopped", "done"
  std::string activity;
  /// 0..1: known reachable floor, divided by the sum of that and the floor estimated behind the openings.
  double progress = 0.0;
  bool step_done = false;
  std::vector<Point2> planned_path;
  std::vector<ExploreEvent> events;
  std::optional<ExploreDecision> decision;  ///< the newest decision, present in the step that made it
  std::optional<ExploreEnd> end;            ///< present from the last step on
};

/// Runs one exploration. It is not thread-safe, and its outputs depend on its inputs alone.
class Exploration {
 public:
  /// Checks the request and makes an exploration. kInvalidArgument: a parameter or polygon is invalid.
  [[nodiscard]] static Result<Exploration> create(const ExploreRequest& request, const ExploreParams& params);
  Exploration(Exploration&&) noexcept;
  Exploration& operator=(Exploration&&) noexcept;
  Exploration(const Exploration&) = delete;
  Exploration& operator=(const Exploration&) = delete;
  ~Exploration();

  /// Computes one control step; it is called at 10 Hz. After the end it repeats the end with a zero command.
  [[nodiscard]] ExploreStep step(const ExploreInput& input);
  /// Excludes the time between the previous step and `now` from all time limits; drives start again.
  void resume(RobotTime now);
  /// The map was corrected (new epoch): `move` takes old map coordinates to new ones.
  void transform(const MapMove& move);
  /// The end that will be reported on arrival, while the robot still returns to the start.
  [[nodiscard]] std::optional<ExploreEnd> pending_end() const;
  /// Restores what the strategy knew before the program was interrupted. Call it before the first step.
  void remember(const TopologyMemory& memory);
  /// Restores the start position of an interrupted exploration, frame `map`. Call it before the first step.
  void remember_start(const Point2& start_map);
  /// The strategy, for reading its topology; valid as long as the exploration is not moved.
  [[nodiscard]] const ExploreStrategy& strategy() const;

 private:
  class Impl;
  explicit Exploration(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace seeker::explore
