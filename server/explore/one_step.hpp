/// \file
/// The rule of the active-SLAM paper: of the controls that may be held for one observation period, the one with the
/// largest objective (spec S1.11, eq (22)).
#pragma once

#include <optional>
#include <vector>

#include "server/explore/control_check.hpp"
#include "server/explore/one_step_params.hpp"
#include "server/explore/segment_sight.hpp"
#include "server/explore/strategy.hpp"

namespace seeker::explore {

/// Every control of the set but standing still.
[[nodiscard]] std::vector<Twist2> controls_of(const OneStepParams& params);

/// The walls that matter to a decision of one step. `floor` is taken from the input where the parameters want it; the
/// scene is valid as long as `floor`.
[[nodiscard]] SightScene scene_around(const StrategyInput& input, const std::vector<MapSegment>& segments,
                                      const OneStepParams& params, const std::shared_ptr<const nav::FloorView>& floor);

/// Farthest way of one control.
[[nodiscard]] double longest_step_m(const OneStepParams& params);

struct OneStepChoice {
  ExploreDecision decision;
  std::optional<Twist2> control;  ///< nothing: none may be held
  bool gains_nothing = false;     ///< no available control lengthens a wall or finds an end
  bool sees_walls = true;         ///< false: there is no wall within range; straight ahead until there is one
};

/// `segments`: those of the input, or what is to be believed of them (ends that are known to lead nowhere are real).
[[nodiscard]] OneStepChoice choose_one_step(const StrategyInput& input, const std::vector<MapSegment>& segments,
                                            const OneStepParams& params);

}  // namespace seeker::explore
