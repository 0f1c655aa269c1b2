#include "server/app/fleet/own_robot.hpp"

#include <utility>

namespace seeker::app {
namespace {

std::vector<Point2> places_of(const LineMap& map) {
  std::vector<Point2> places;
  places.reserve(map.nodes.size());
  for (const MapNode& node : map.nodes) {
    places.push_back(node.map_T_node.translation());
  }
  return places;
}

}  // namespace

void OwnRobot::recall(const LineMap& map, const std::optional<RobotTopology>& topology,
                      std::vector<api::Detection> found) {
  const std::lock_guard lock(mutex_);
  remembered_ = true;
  places_ = places_of(map);
  if (topology) {
    report_.topology = topology;
    report_.topology->velocity.reset();
    report_.topology->active = false;
  }
  report_.finds.before = std::move(found);
}

void OwnRobot::keep_remembered() {
  const std::lock_guard lock(mutex_);
  remembered_ = true;
}

void OwnRobot::take_map(const OwnMap& own, bool is_new_map) {
  const std::lock_guard lock(mutex_);
  map_T_base_ = own.map_T_base;
  places_ = places_of(own.map);
  pictures_ = own.pictures.size();
  if (is_new_map) {
    forget_report();
  }
  remembered_ = false;
}

/// Its poses are in a map that is no more; those in the new one are reported soon.
void OwnRobot::forget_report() {
  RobotReport before = std::exchange(report_, {});
  if (!remembered_) {
    report_.topology = std::move(before.topology);  // the loop has reported it since
  }
}

void OwnRobot::receive(const OwnTopology& reported) {
  const std::lock_guard lock(mutex_);
  map_T_base_ = reported ? std::optional(reported->map_T_base) : std::nullopt;
  report_.receive_topology(remembered_ ? std::nullopt : reported);
}

bool OwnRobot::receive(const OwnSeen& seen, WallTime received_at) {
  const std::lock_guard lock(mutex_);
  if (!seen.placed || remembered_) {
    return false;
  }
  const bool found_more = report_.receive_seen(seen.floor, seen.sides, seen.detections, seen.searched, received_at);
  if (!seen.searched) {
    report_.search = {};  // its program is this one: it has forgotten nothing, but is in another map
  }
  return found_more;
}

bool OwnRobot::remembered() const {
  const std::lock_guard lock(mutex_);
  return remembered_;
}

RobotReport OwnRobot::report() const {
  const std::lock_guard lock(mutex_);
  return report_;
}

api::FleetMember OwnRobot::describe() const {
  const std::lock_guard lock(mutex_);
  api::FleetMember own;
  own.robot_id = robot_id_;
  own.state = api::FleetState::kMerged;
  own.confidence = 1.0;
  own.linked = true;
  own.nodes = static_cast<std::uint32_t>(places_.size());
  own.pictures = static_cast<std::uint32_t>(pictures_);
  own.main_T_map = Pose2{};
  own.main_T_base = map_T_base_;
  own.places = places_;
  own.detections = report_.finds.all();
  return own;
}

}  // namespace seeker::app
