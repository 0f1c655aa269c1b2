/// \file
/// A whole exploration: a strategy, the ground it may use, what sends the robot back, how it ends. Stepped by the robot
/// loop; pure.
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
  StrategyMaker strategy = maker_of(Strategy::kActive);
  nav::ForbiddenAreas areas;     ///< frame `map`
  bool return_to_start = false;  ///< drive back to where the first step was made, before the time is up
};

/// What the robot knows at one control step. Pointers and references are valid during the call.
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
  const FleetView* fleet = nullptr;                  ///< other robots, frame `map`; null: the robot is alone
  std::vector<nav::Mover> movers = {};               ///< other robots where they are now, frame `map`
  std::optional<double> time_left_s = std::nullopt;  ///< until it is ended from outside; nothing: it has all the time
};

enum class EndKind : std::uint8_t {
  kComplete,      ///< nothing is left to explore
  kBoundReached,  ///< all that is left lies beyond the bound or in kept-out ground
  kUnreachable,   ///< places are left that no way leads to
  kUncertain,     ///< the robot could not find back to certainty
  kBattery,
  kTimeLimit,  ///< what time was left was needed for the way back to the start
};

struct ExploreEnd {
  EndKind kind = EndKind::kComplete;
  std::string cause;
  std::string remedy;
  std::vector<Point2> unreachable;  ///< frame `map`

  friend bool operator==(const ExploreEnd&, const ExploreEnd&) = default;
};

struct ExploreEvent {
  std::string kind;  ///< "trap", "escape", "uncertain", "certain", "battery", "time", "return", "unreachable"
  std::string text;

  friend bool operator==(const ExploreEvent&, const ExploreEvent&) = default;
};

struct ExploreStep {
  Twist2 command;
  std::string phase;  ///< a strategy's, "wait", "regain", "return", "stopped", "done"
  std::string activity;
  double progress = 0.0;  ///< 0..1: known reachable floor over that and what is estimated to lie behind the openings
  bool step_done = false;
  std::vector<Point2> planned_path;
  std::vector<ExploreEvent> events;
  std::optional<ExploreDecision> decision;  ///< the newest, in the step that made it
  std::optional<ExploreEnd> end;            ///< from the last step on
};

/// Not thread-safe; everything it does follows from its inputs.
class Exploration {
 public:
  /// kInvalidArgument: parameters or polygons that make no sense.
  [[nodiscard]] static Result<Exploration> create(const ExploreRequest& request, const ExploreParams& params);
  Exploration(Exploration&&) noexcept;
  Exploration& operator=(Exploration&&) noexcept;
  Exploration(const Exploration&) = delete;
  Exploration& operator=(const Exploration&) = delete;
  ~Exploration();

  /// One control step, 10 Hz. After the end it repeats the end with a zero command.
  [[nodiscard]] ExploreStep step(const ExploreInput& input);
  /// Time between this and the step before does not count; drives start anew.
  void resume(RobotTime now);
  /// The map moved (new epoch): `move` takes old map coordinates to new ones.
  void transform(const MapMove& move);
  /// How it ended where the robot is still on its way back to the start.
  [[nodiscard]] std::optional<ExploreEnd> pending_end() const;
  /// Before the first step: what the strategy knew when the program was cut off.
  void remember(const TopologyMemory& memory);
  /// Before the first step: where it began before the program was cut off, frame `map`.
  void remember_start(const Point2& start_map);
  /// The strategy, for what it tells of its topology; valid as long as the exploration is not moved.
  [[nodiscard]] const ExploreStrategy& strategy() const;

 private:
  class Impl;
  explicit Exploration(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace seeker::explore
