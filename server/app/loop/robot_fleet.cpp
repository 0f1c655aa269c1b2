// What the loop tells of itself to its fleet, and what it makes of what the others told.

#include <algorithm>
#include <utility>

#include "server/app/loop/robot_loop.hpp"
#include "server/fleet/topology_map.hpp"

namespace seeker::app {

void RobotLoop::set_fleet(std::optional<FleetView> fleet) {
  fleet_ = std::move(fleet);
  fleet_at_ = now();
}

/// Where the others are now: on from where they told, for the time since.
std::vector<nav::Mover> RobotLoop::movers() const {
  std::vector<nav::Mover> movers;
  const Duration age = now() - fleet_at_;
  if (!fleet_ || age > params_.fleet.max_age) {
    return movers;
  }
  for (const RobotTopology& other : fleet_->others) {
    if (other.velocity) {
      nav::Mover mover;
      mover.frame_T_base = other.map_T_base * integrate(*other.velocity, to_seconds(age));
      mover.velocity = *other.velocity;
      mover.radius_m = params_.fleet.robot_radius_m;
      mover.slack_m = params_.fleet.slack_m + params_.fleet.slack_m_s * to_seconds(age);
      movers.push_back(mover);
    }
  }
  return movers;
}

std::vector<nav::Mover> RobotLoop::movers_base(const Pose2& map_T_base) const {
  std::vector<nav::Mover> all = nav::moved(movers(), inverse(map_T_base));
  if (odometry_) {
    const std::vector<nav::Mover> seen = seen_movers_.movers_base(odometry_->odom_T_base, now());
    all.insert(all.end(), seen.begin(), seen.end());
  }
  return all;
}

const LaserScan& RobotLoop::scan_of_building() {
  const std::vector<nav::Mover> others = movers_base(parts_.estimator->estimate().map_T_base);
  if (others.empty()) {
    return *scan_;
  }
  building_ = nav::without_movers(*scan_, Pose2{}, others);
  return building_;
}

void RobotLoop::note_topology() {
  const Behaviour* behaviour = missions_.behaviour();
  const Topology* topology = behaviour != nullptr ? behaviour->topology() : nullptr;
  own_topology_.map_T_base = pose_.map_T_base;
  own_topology_.velocity = odometry_ ? odometry_->velocity : Twist2{};
  own_topology_.active = topology != nullptr;
  own_topology_.target_map = topology != nullptr ? behaviour->target_map() : std::nullopt;
  if (topology != nullptr) {
    own_topology_.topology = *topology;
  }
}

void RobotLoop::move_fleet(const Pose2& new_T_old) {
  own_topology_.topology = fleet::moved(std::move(own_topology_.topology), new_T_old);
  if (fleet_) {
    fleet_->floor.reset();  // the next view brings it anew
    if (fleet_->searched) {
      // What was proved stays proved until then: a search would else drive to floor that others have searched.
      std::vector<SearchedFloor> searched = *fleet_->searched;
      for (SearchedFloor& one : searched) {
        one.map_T_grid = new_T_old * one.map_T_grid;
      }
      fleet_->searched = std::make_shared<const std::vector<SearchedFloor>>(std::move(searched));
    }
    for (RobotTopology& other : fleet_->others) {
      other = fleet::moved(std::move(other), new_T_old);
    }
  }
}

}  // namespace seeker::app
