/// \file
/// The rule of the active-SLAM paper: of the controls that may be held for one observation period, choose the one with
/// the largest objective (spec S1.11, eq (22)).
#pragma once

#include <optional>
#include <vector>

#include "server/explore/control_check.hpp"
#include "server/explore/one_step_params.hpp"
#include "server/explore/segment_sight.hpp"
#include "server/explore/strategy.hpp"

namespace seeker::explore {

/// All controls of the set except standing still.
[[nodiscard]] std::vector<Twist2> controls_of(const OneStepParams& params);

/// The walls that matter to a decision of one step. The scene uses `floor` when the parameters request it, and is valid
/// as long as `floor`.
[[nodiscard]] SightScene scene_around(const StrategyInput& input, const std::vector<MapSegment>& segments,
                                      const OneStepParams& params, const std::shared_ptr<const nav::FloorView>& floor);

/// Path length of the fastest control over one period.
[[nodiscard]] double longest_step_m(const OneStepParams& params);

struct OneStepChoice {
  ExploreDecision decision;
  std::optional<Twist2> control;  ///< nothing: no control may be held
  bool gains_nothing = false;     ///< no available control extends a wall or observes a new end
  bool sees_walls = true;  ///< false: no wall is within range, and the robot drives straight ahead until there is one
};

/// Chooses the control of one step. `segments` are those of the input, possibly with ends marked as real that are known
/// to lead nowhere.
[[nodiscard]] OneStepChoice choose_one_step(const StrategyInput& input, const std::vector<MapSegment>& segments,
                                            const OneStepParams& params);

}  // namespace seeker::explore
