#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "common/core/angle.hpp"
#include "common/wire/convert.hpp"
#include "common/wire/convert_fleet.hpp"
#include "common/wire/fleet_fields.hpp"

namespace seeker::wire {
namespace {

constexpr int kSectorNumbers = 5;
constexpr int kEdgeNumbers = 2;
/// A full turn in single precision may be a little more than in double.
constexpr double kMaxSpan_rad = kTwoPi + 1e-5;
/// Of a robot of a fleet.
constexpr double kMaxSpeed_m_s = 10.0;
constexpr double kMaxTurn_rad_s = 20.0;

void write_place(const TopologyNode& from, pb::FleetPlace* to) {
  to->set_id(from.id);
  write(from.map_T_base, to->mutable_map_t_base());
  for (const FreeSector& sector : from.sectors) {
    for (const double number :
         {sector.from_base.x(), sector.from_base.y(), sector.start_rad, sector.span_rad, sector.radius_m}) {
      to->add_sectors(static_cast<float>(number));
    }
  }
  for (const TopologyGoal& goal : from.goals) {
    pb::FleetGoal* one = to->add_goals();
    one->set_id(goal.id);
    write(goal.p_map, one->mutable_p_map());
    one->set_layer(static_cast<std::uint32_t>(goal.layer));
  }
}

Point2 read_point(bool present, const pb::Point2& from, std::string_view field, Check& check) {
  Point2 p = Point2::Zero();
  read_required(present, from, p, field, check);
  return {within(p.x(), api::kMaxFleetReach_m, field, check), within(p.y(), api::kMaxFleetReach_m, field, check)};
}

void read_goal(const pb::FleetGoal& from, const Point2& place_map, TopologyGoal& to, Check& check) {
  to.id = from.id();
  to.p_map = read_point(from.has_p_map(), from.p_map(), "p_map", check);
  to.layer = check.natural("layer", from.layer());
  if (to.id == 0 || to.layer < 1 || to.layer > api::kMaxFleetLayer) {
    check.refuse("layer", Errc::kInvalidArgument, "must be from 1 to 64, and the id of the goal above 0");
  }
  if (check.ok() && (to.p_map - place_map).norm() > api::kMaxFleetGoal_m) {
    check.refuse("p_map", Errc::kInvalidArgument, "lies too far from the place it is bound to");
  }
}

void read_sectors(const pb::FleetPlace& from, std::vector<FreeSector>& to, Check& check) {
  if (from.sectors_size() % kSectorNumbers != 0) {
    check.refuse("sectors", Errc::kInvalidArgument, "does not have five numbers each");
    return;
  }
  to.reserve(static_cast<std::size_t>(from.sectors_size() / kSectorNumbers));
  for (int k = 0; k < from.sectors_size(); k += kSectorNumbers) {
    const auto number = [&](int at, double limit) {
      return within(static_cast<double>(from.sectors(k + at)), limit, "sectors", check);
    };
    FreeSector sector;
    sector.from_base = {number(0, api::kMaxFleetGoal_m), number(1, api::kMaxFleetGoal_m)};
    sector.start_rad = wrap_angle(number(2, kTwoPi));
    sector.span_rad = number(3, kMaxSpan_rad);
    sector.radius_m = number(4, api::kMaxFleetGoal_m);
    if (sector.span_rad < 0.0 || sector.radius_m < 0.0) {
      check.refuse("sectors", Errc::kInvalidArgument, "has a span or a radius below 0");
    }
    to.push_back(sector);
  }
}

void read_place(const pb::FleetPlace& from, TopologyNode& to, Check& check) {
  to.id = from.id();
  to.map_T_base = read_place_pose(from.has_map_t_base(), from.map_t_base(), "map_t_base", check);
  read_sectors(from, to.sectors, check);
  for (int k = 0; k < from.goals_size(); ++k) {
    const auto scope = check.in("goals", static_cast<std::size_t>(k));
    read_goal(from.goals(k), to.map_T_base.translation(), to.goals.emplace_back(), check);
  }
}

/// Before memory is spent on them.
bool check_counts(const pb::FleetTopology& from, Check& check) {
  std::size_t goals = 0;
  std::size_t sectors = 0;
  for (const pb::FleetPlace& place : from.places()) {
    goals += static_cast<std::size_t>(place.goals_size());
    sectors += static_cast<std::size_t>(place.sectors_size() / kSectorNumbers);
  }
  return check.count("places", static_cast<std::size_t>(from.places_size()), api::kMaxFleetPlaces) &&
         check.count("goals", goals, api::kMaxFleetGoals) && check.count("sectors", sectors, api::kMaxFleetSectors) &&
         check.count("edges", static_cast<std::size_t>(from.edges_size() / kEdgeNumbers), api::kMaxFleetTopologyEdges);
}

void read_edges(const pb::FleetTopology& from, Topology& to, Check& check) {
  std::set<std::uint64_t> known;
  for (const TopologyNode& node : to.nodes) {
    if (node.id == 0 || (!known.empty() && node.id <= *known.rbegin())) {
      check.refuse("places", Errc::kInvalidArgument, "must have rising ids above 0");
    }
    known.insert(node.id);
  }
  if (from.edges_size() % kEdgeNumbers != 0) {
    check.refuse("edges", Errc::kInvalidArgument, "does not have two places each");
    return;
  }
  for (int k = 0; k < from.edges_size(); k += kEdgeNumbers) {
    to.edges.push_back({from.edges(k), from.edges(k + 1)});
    if (!known.contains(from.edges(k)) || !known.contains(from.edges(k + 1))) {
      check.refuse("edges", Errc::kInvalidArgument, "leads to a place that is not there");
    }
  }
  to.current = from.current();
  if (to.current != 0 && !known.contains(to.current)) {
    check.refuse("current", Errc::kInvalidArgument, "is a place that is not there");
  }
}

}  // namespace

double within(double value, double limit, std::string_view field, Check& check) {
  if (!(std::abs(value) <= limit)) {  // also where it is no number
    check.refuse(field, Errc::kInvalidArgument, "is out of reach or not a finite number");
    return 0.0;
  }
  return value;
}

Pose2 read_place_pose(bool present, const pb::Pose2& from, std::string_view field, Check& check) {
  Pose2 pose;
  read_required(present, from, pose, field, check);
  within(pose.x_m, api::kMaxFleetReach_m, field, check);
  within(pose.y_m, api::kMaxFleetReach_m, field, check);
  return pose;
}

void write_others(const std::vector<RobotTopology>& from, pb::FleetReply* to) {
  for (const RobotTopology& other : from) {
    write(other, to->add_others());
  }
}

void read_others(const pb::FleetReply& from, std::vector<RobotTopology>& to, std::size_t most, Check& check) {
  if (!check.count("others", static_cast<std::size_t>(from.others_size()), most)) {
    return;
  }
  for (int k = 0; k < from.others_size(); ++k) {
    const auto scope = check.in("others", static_cast<std::size_t>(k));
    read(from.others(k), to.emplace_back(), check);
  }
}

void write(const RobotTopology& from, pb::FleetTopology* to) {
  to->set_robot_id(from.robot_id);
  write(from.map_T_base, to->mutable_map_t_base());
  for (const TopologyNode& node : from.topology.nodes) {
    write_place(node, to->add_places());
  }
  for (const TopologyEdge& edge : from.topology.edges) {
    to->add_edges(edge.a);
    to->add_edges(edge.b);
  }
  to->set_current(from.topology.current);
  if (from.target_map) {
    write(*from.target_map, to->mutable_target_map());
  }
  to->set_active(from.active);
  if (from.velocity) {
    write(*from.velocity, to->mutable_velocity());
  }
}

void read(const pb::FleetTopology& from, RobotTopology& to, Check& check) {
  if (!check_counts(from, check)) {
    return;
  }
  to.robot_id = read_robot_id(from.robot_id(), check);
  to.map_T_base = read_place_pose(from.has_map_t_base(), from.map_t_base(), "map_t_base", check);
  for (int k = 0; k < from.places_size(); ++k) {
    const auto scope = check.in("places", static_cast<std::size_t>(k));
    read_place(from.places(k), to.topology.nodes.emplace_back(), check);
  }
  read_edges(from, to.topology, check);
  if (from.has_target_map()) {
    to.target_map = read_point(true, from.target_map(), "target_map", check);
  }
  to.active = from.active();
  if (from.has_velocity()) {
    const auto scope = check.in("velocity");
    read(from.velocity(), to.velocity.emplace(), check);
    if (check.ok() &&
        (std::abs(to.velocity->v_m_s) > kMaxSpeed_m_s || std::abs(to.velocity->omega_rad_s) > kMaxTurn_rad_s)) {
      check.refuse("", Errc::kInvalidArgument, "is faster than any robot of ours");
    }
  }
}

void write(const api::FleetShare& from, pb::FleetShare* to) {
  to->set_robot_id(from.robot_id);
  to->set_instance(from.instance);
  if (from.topology) {
    write(*from.topology, to->mutable_topology());
  }
}

void read(const pb::FleetShare& from, api::FleetShare& to, Check& check) {
  to.robot_id = read_robot_id(from.robot_id(), check);
  to.instance = from.instance();
  if (from.has_topology()) {
    const auto scope = check.in("topology");
    read(from.topology(), to.topology.emplace(), check);
    if (check.ok() && to.topology->robot_id != to.robot_id) {
      check.refuse("robot_id", Errc::kInvalidArgument, "is not the robot that sends it");
    }
  }
}

void write(const api::FleetShared& from, pb::FleetReply* to) {
  to->set_state(static_cast<pb::FleetState>(wire_enum(from.state)));
  write_others(from.others, to);
}

void read(const pb::FleetReply& from, api::FleetShared& to, Check& check) {
  check.enumerator("state", from.state(), api::FleetState::kSplit, to.state);
  read_others(from, to.others, api::kMaxFleetRobots - 1, check);
}

}  // namespace seeker::wire
