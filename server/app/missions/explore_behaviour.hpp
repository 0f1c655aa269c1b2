/// \file
/// Mission `explore`: the exploration of server/explore behind the loop's behaviour interface.
#pragma once

#include <memory>

#include "server/app/maps/segment_view.hpp"
#include "server/app/missions/behaviour.hpp"
#include "server/explore/exploration.hpp"
#include "server/fleet/topological_strategy.hpp"

namespace seeker::app {

/// kRefused where the robot's map of segments cannot grow: the estimator keeps none, or it is only localised in.
[[nodiscard]] Status check_map_grows(const Situation& situation);

/// The sentence of a decision in the mission's log: what was chosen and what spoke for it.
[[nodiscard]] std::string describe(const ExploreDecision& decision);

/// Numbers of the exploration, and of the strategies that have their own.
struct ExploreSettings {
  explore::ExploreParams params;
  fleet::TopologicalParams topology;
};

/// What makes the strategy that a mission names.
[[nodiscard]] explore::StrategyMaker maker_of(api::ExploreStrategy strategy, const fleet::TopologicalParams& topology);

class ExploreBehaviour final : public Behaviour {
 public:
  /// Errors of check_map_grows() and of explore::Exploration::create().
  [[nodiscard]] static Result<std::unique_ptr<Behaviour>> create(const ExploreSettings& settings,
                                                                 const api::ExploreMission& mission,
                                                                 const Situation& situation);

  [[nodiscard]] Decision step(const Situation& situation) override;
  void resumed(RobotTime now) override { exploration_.resume(now); }
  void map_moved(const MapMove& move) override;
  [[nodiscard]] std::optional<api::MissionEnd> pending_end() const override;
  [[nodiscard]] const Topology* topology() const override { return exploration_.strategy().topology(); }
  [[nodiscard]] std::optional<Point2> target_map() const override { return exploration_.strategy().target_map(); }
  [[nodiscard]] bool shares_exploration() const override { return exploration_.strategy().shares(); }
  [[nodiscard]] MissionMemory memory() const override {
    return {.topology = exploration_.strategy().memory(), .search = std::nullopt};
  }
  void remember(const MissionMemory& memory) override {
    if (memory.topology) {
      exploration_.remember(*memory.topology);
    }
  }
  void remember_start(const Point2& start_map) override { exploration_.remember_start(start_map); }

 private:
  ExploreBehaviour(explore::Exploration exploration, Duration segments_period)
      : exploration_(std::move(exploration)), segments_(segments_period) {}

  explore::Exploration exploration_;
  SegmentView segments_;
};

}  // namespace seeker::app
