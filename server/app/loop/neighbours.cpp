#include "server/app/loop/neighbours.hpp"

#include <memory>
#include <utility>

#include "common/api/fleet.hpp"
#include "server/fleet/topology_map.hpp"

namespace seeker::app {

void Neighbours::set_fleet(std::optional<FleetView> fleet, RobotTime now) {
  fleet_ = std::move(fleet);
  fleet_at_ = now;
}

void Neighbours::observe(const LaserScan& scan, const Pose2& odom_T_base, RobotTime now) {
  seen_movers_.look(scan, odom_T_base, now);
}

/// Brought on from the reported place for the time since.
std::vector<nav::Mover> Neighbours::fleet_movers(RobotTime now) const {
  std::vector<nav::Mover> movers;
  const Duration age = now - fleet_at_;
  if (!fleet_ || age > params_.max_age) {
    return movers;
  }
  for (const RobotTopology& other : fleet_->others) {
    if (other.velocity) {
      nav::Mover mover;
      mover.frame_T_base = other.map_T_base * integrate(*other.velocity, to_seconds(age));
      mover.velocity = *other.velocity;
      mover.radius_m = params_.robot_radius_m;
      mover.slack_m = params_.slack_m + params_.slack_m_s * to_seconds(age);
      movers.push_back(mover);
    }
  }
  return movers;
}

std::vector<nav::Mover> Neighbours::movers_base(const Pose2& map_T_base, const std::optional<Pose2>& odom_T_base,
                                                RobotTime now) const {
  std::vector<nav::Mover> all = nav::moved(fleet_movers(now), inverse(map_T_base));
  if (odom_T_base) {
    const std::vector<nav::Mover> seen = seen_movers_.movers_base(*odom_T_base, now);
    all.insert(all.end(), seen.begin(), seen.end());
  }
  return all;
}

void Neighbours::note_own(const Behaviour* behaviour, const Pose2& map_T_base, const Twist2& velocity) {
  const Topology* topology = behaviour != nullptr ? behaviour->topology() : nullptr;
  own_.map_T_base = map_T_base;
  own_.velocity = velocity;
  own_.active = behaviour != nullptr && behaviour->shares_exploration();
  own_.target_map = own_.active ? behaviour->target_map() : std::nullopt;
  if (topology != nullptr) {
    own_.topology = *topology;
    newest_node_ = topology->nodes.empty() ? 0 : topology->nodes.back().id;
  } else {
    newest_node_ = pictured_node_ = 0;  // the next exploration numbers its nodes anew
  }
}

void Neighbours::keep_picture(fleet::NodePicture picture) {
  own_pictures_.push_back(std::make_shared<const fleet::NodePicture>(std::move(picture)));
  if (own_pictures_.size() > api::kMaxFleetPictures) {
    own_pictures_.erase(own_pictures_.begin());
  }
}

void Neighbours::map_moved(const Pose2& new_T_old) {
  own_.topology = fleet::moved(std::move(own_.topology), new_T_old);
  if (!fleet_) {
    return;
  }
  fleet_->floor.reset();  // the next view brings it anew
  if (fleet_->sides) {
    fleet_->sides = std::make_shared<const std::vector<MappedSide>>(moved(*fleet_->sides, new_T_old));
  }
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

void Neighbours::forget_places() {
  std::string robot_id = std::move(own_.robot_id);
  own_ = {};
  own_.robot_id = std::move(robot_id);
  own_pictures_.clear();
  newest_node_ = pictured_node_ = 0;
  fleet_.reset();
}

}  // namespace seeker::app
