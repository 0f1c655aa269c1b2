/// \file
/// Neighbours knows the robots around this one: as the fleet reports them, and as the laser observes them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/core/pose2.hpp"
#include "common/core/scan.hpp"
#include "common/core/time.hpp"
#include "common/core/topology.hpp"
#include "server/app/loop/loop_params.hpp"
#include "server/app/missions/behaviour.hpp"
#include "server/fleet/node_picture.hpp"
#include "server/nav/movers.hpp"
#include "server/nav/seen_movers.hpp"

namespace seeker::app {

/// Owns the view of the fleet, the movers that were observed, and what this robot reports of itself. Lives on the
/// loop's thread; places are in frame `map`.
class Neighbours {
 public:
  Neighbours(const FleetMotionParams& params, std::string robot_id) : params_(params) {
    own_.robot_id = std::move(robot_id);
  }

  /// Sets what is known of the fleet from `now` on; without a value the robot is alone.
  void set_fleet(std::optional<FleetView> fleet, RobotTime now);
  /// Returns the view of the fleet; null when the robot is alone.
  [[nodiscard]] const FleetView* fleet() const { return fleet_ ? &*fleet_ : nullptr; }
  /// Looks for moving bodies in a new scan; `odom_T_base` is where the base was when it was taken.
  void observe(const LaserScan& scan, const Pose2& odom_T_base, RobotTime now);

  /// Robots of the fleet that reported lately, and moving bodies that the laser observes; frame `base` of the
  /// robot at that place. Without an odometry reading (`odom_T_base`) only the former.
  [[nodiscard]] std::vector<nav::Mover> movers_base(const Pose2& map_T_base, const std::optional<Pose2>& odom_T_base,
                                                    RobotTime now) const;

  /// Updates what is reported to the fleet: where the robot is, and its share of an exploration while one runs.
  /// `behaviour` may be null.
  void note_own(const Behaviour* behaviour, const Pose2& map_T_base, const Twist2& velocity);
  /// Returns that report; it is inactive while no exploration runs that robots share.
  [[nodiscard]] const RobotTopology& own() const { return own_; }

  /// Whether the robot has made a node of its topology of which no picture was begun.
  [[nodiscard]] bool wants_picture() const { return newest_node_ != pictured_node_; }
  /// A picture of the newest node is being taken; keep_picture() follows, unless it fails.
  void picture_begun() { pictured_node_ = newest_node_; }
  /// Keeps the picture of a node for the fleet. Beyond api::kMaxFleetPictures the oldest one is dropped.
  void keep_picture(fleet::NodePicture picture);
  /// Returns the pictures of all nodes, in the order in which they were taken.
  [[nodiscard]] const fleet::NodePictures& own_pictures() const { return own_pictures_; }

  /// The map was corrected around the robot by `new_T_old`: everything that is known here moves with it.
  void map_moved(const Pose2& new_T_old);
  /// Call it when another map takes the place of the present one.
  void forget_places();

 private:
  [[nodiscard]] std::vector<nav::Mover> fleet_movers(RobotTime now) const;

  FleetMotionParams params_;
  std::optional<FleetView> fleet_;
  RobotTime fleet_at_;  ///< when it was reported
  nav::SeenMovers seen_movers_;
  RobotTopology own_;
  fleet::NodePictures own_pictures_;
  std::uint64_t newest_node_ = 0;    ///< id of the newest node of the topology; 0: none yet
  std::uint64_t pictured_node_ = 0;  ///< of the node at which the last picture was begun
};

}  // namespace seeker::app
