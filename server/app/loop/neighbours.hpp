/// \file
/// The robots around this one: what the fleet reports of them, and what the laser sees driving about.
#pragma once

#include <optional>
#include <vector>

#include "common/core/pose2.hpp"
#include "common/core/scan.hpp"
#include "common/core/time.hpp"
#include "common/core/topology.hpp"
#include "server/app/loop/loop_params.hpp"
#include "server/app/missions/behaviour.hpp"
#include "server/nav/movers.hpp"
#include "server/nav/seen_movers.hpp"

namespace seeker::app {

/// Owner of the view of the fleet, of the movers that were seen, and of what this robot reports of itself. Lives on the
/// loop's thread; places are in frame `map`.
class Neighbours {
 public:
  explicit Neighbours(const FleetMotionParams& params) : params_(params) {}

  /// What the robot knows of its fleet from `now` on; nothing: it is alone.
  void set_fleet(std::optional<FleetView> fleet, RobotTime now);
  /// Null: the robot is alone.
  [[nodiscard]] const FleetView* fleet() const { return fleet_ ? &*fleet_ : nullptr; }
  /// A new scan, and the base by dead reckoning when it was taken.
  void observe(const LaserScan& scan, const Pose2& odom_T_base, RobotTime now);

  /// Robots of the fleet that were heard of lately, and whatever the laser sees driving about; frame `base` of the
  /// robot at that place. Without an odometry reading (`odom_T_base`) only the former.
  [[nodiscard]] std::vector<nav::Mover> movers_base(const Pose2& map_T_base, const std::optional<Pose2>& odom_T_base,
                                                    RobotTime now) const;

  /// What the robot reports to its fleet: where it is, and its exploration by topology while one runs. `behaviour` may
  /// be null.
  void note_own(const Behaviour* behaviour, const Pose2& map_T_base, const Twist2& velocity);
  /// The report without the robot's id; inactive while no exploration by topology runs.
  [[nodiscard]] const RobotTopology& own() const { return own_; }

  /// The map was corrected around the robot by `new_T_old`: everything that is known here moves with it.
  void map_moved(const Pose2& new_T_old);
  /// Another map takes the place of the present one.
  void forget_places();

 private:
  [[nodiscard]] std::vector<nav::Mover> fleet_movers(RobotTime now) const;

  FleetMotionParams params_;
  std::optional<FleetView> fleet_;
  RobotTime fleet_at_;  ///< when it was reported
  nav::SeenMovers seen_movers_;
  RobotTopology own_;
};

}  // namespace seeker::app
