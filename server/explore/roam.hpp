/// \file
/// The baseline of the active-SLAM paper: straight on until something is near, then turn until the way is clear (spec
/// S1.13).
#pragma once

#include "server/explore/explore_params.hpp"
#include "server/explore/strategy.hpp"

namespace seeker::explore {

/// Never done: it goes on until somebody ends it.
class RoamStrategy final : public ExploreStrategy {
 public:
  RoamStrategy(const RoamParams& params, const nav::ClearanceParams& clearance);

  [[nodiscard]] StrategyStep step(const StrategyInput& input) override;
  void interrupted(RobotTime now) override;
  void transform(const MapMove& move) override;

 private:
  [[nodiscard]] double free_way_m(const StrategyInput& input, const std::vector<Point2>& points_base) const;

  RoamParams params_;
  nav::ClearanceParams clearance_;
  double turn_rad_s_ = 0.0;  ///< 0: driving straight
  bool started_ = false;
};

}  // namespace seeker::explore
