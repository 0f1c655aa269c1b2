/// \file
/// The baseline of the active-SLAM paper: drive straight on until an obstacle is near, then rotate until the path is
/// clear (spec S1.13).
#pragma once

#include "server/explore/explore_params.hpp"
#include "server/explore/strategy.hpp"

namespace seeker::explore {

/// Exploration without an end of its own: it continues until it is stopped.
class RoamStrategy final : public ExploreStrategy {
 public:
  RoamStrategy(const RoamParams& params, const nav::ClearanceParams& clearance);

  [[nodiscard]] StrategyStep step(const StrategyInput& input) override;
  void interrupted(RobotTime now) override;
  void transform(const MapMove& move) override;

 private:
  [[nodiscard]] double free_distance_m(const StrategyInput& input, const std::vector<Point2>& points_base) const;

  RoamParams params_;
  nav::ClearanceParams clearance_;
  double rotation_rad_s_ = 0.0;  ///< rotation speed; 0 while driving straight
  bool started_ = false;
};

}  // namespace seeker::explore
