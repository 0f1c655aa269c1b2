#include "server/app/loop/situation_source.hpp"

namespace seeker::app {

std::vector<nav::Mover> SituationSource::movers_base() const {
  const std::optional<Pose2> odom_T_base =
      sensing_.odometry() != nullptr ? std::optional(sensing_.odom_T_base()) : std::nullopt;
  return neighbours_.movers_base(localiser_.pose().map_T_base, odom_T_base, world_.now());
}

Situation SituationSource::situation() const {
  Situation s;
  s.now = world_.now();
  s.pose = localiser_.pose();
  s.velocity = sensing_.velocity();
  s.scan = sensing_.scan_for(sensing_.connections().planner);
  s.sonar = sensing_.sonar_for(sensing_.connections().planner);
  s.map = &localiser_.map().occupancy();
  s.tracker = localiser_.tracker();
  s.relocalising = localiser_.map().relocalising();
  s.map_is_read_only = localiser_.map().identity().use == api::MapUse::kLocalise;
  s.battery_v = sensing_.odometry() != nullptr ? sensing_.odometry()->battery_v : std::nullopt;
  s.odom_T_base = sensing_.odom_T_base();
  s.map_name = localiser_.map().identity().name;
  s.has_stereo = has_stereo_;
  s.fleet = neighbours_.fleet();
  s.movers = nav::moved(movers_base(), s.pose.map_T_base);
  return s;
}

}  // namespace seeker::app
