#include "server/fleet/joint_map.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <string>
#include <utility>

#include "server/fleet/map_graph.hpp"
#include "server/fleet/pair_fusion.hpp"
#include "server/slam/covariance.hpp"
#include "server/slam/pose_graph.hpp"

namespace seeker::fleet {
namespace {

constexpr unsigned kNodeBits = 24;
constexpr unsigned kSegmentBits = 48;
/// The work of one join().
class Joiner {
 public:
  Joiner(const std::vector<RobotMap>& maps, const std::vector<MapRelation>& relations, const JointParams& params)
      : maps_(maps), relations_(relations), params_(params) {}

  [[nodiscard]] Status check() const;
  /// Where each robot that hangs together with the first begins, before anything is optimised.
  void spread();
  [[nodiscard]] Status build();
  [[nodiscard]] Status optimise() {
    if (graph_.edge_count() == 0) {
      return {};  // one local map: there is nothing to move
    }
    const auto report = graph_.optimise(params_.max_iterations);
    return report ? Status{} : Status(tl::unexpected<Error>(report.error()));
  }
  [[nodiscard]] JointMap result(std::uint32_t epoch);

 private:
  [[nodiscard]] const LineMap* map_of(std::uint8_t slot) const;
  [[nodiscard]] Pose2 guess_of(const MapRelation& relation) const;
  [[nodiscard]] Status add_relations();
  [[nodiscard]] JointRobot robot_of(std::uint8_t slot);
  void append(std::uint8_t slot, const JointRobot& robot, LineMap& whole) const;
  void append_relations(LineMap& whole) const;

  struct Added {
    std::size_t edge;
    SwitchedOff where;
  };

  const std::vector<RobotMap>& maps_;
  const std::vector<MapRelation>& relations_;
  JointParams params_;
  std::map<std::uint8_t, Pose2> start_;  ///< joint_T_map of those joined
  std::map<std::uint8_t, GraphNodes> nodes_;
  std::vector<Added> added_;
  slam::PoseGraph graph_;
};

const MapNode* find_node(const LineMap& map, std::uint32_t id) {
  const auto found =
      std::find_if(map.nodes.begin(), map.nodes.end(), [&](const MapNode& node) { return node.id == id; });
  return found == map.nodes.end() ? nullptr : &*found;
}

const LineMap* Joiner::map_of(std::uint8_t slot) const {
  const auto found = std::find_if(maps_.begin(), maps_.end(), [&](const RobotMap& m) { return m.slot == slot; });
  return found == maps_.end() ? nullptr : found->map;
}

Status Joiner::check() const {
  if (maps_.empty() || maps_.front().map->nodes.empty()) {
    return fail(Errc::kInvalidArgument, "there is no map to join others to; map something first");
  }
  for (const RobotMap& one : maps_) {
    if (map_of(one.slot) != one.map) {
      return fail(Errc::kInvalidArgument, "two maps claim the slot " + std::to_string(one.slot) + " of the fleet");
    }
    if (one.slot < maps_.front().slot) {
      return fail(Errc::kInvalidArgument,
                  "the first map must be that of the lowest slot: its frame becomes the joint one");
    }
    const bool fits = std::all_of(one.map->nodes.begin(), one.map->nodes.end(),
                                  [](const MapNode& node) { return node.id < kMaxJointNodes; });
    if (!fits || one.map->next_id > kMaxJointSegments) {
      return fail(Errc::kTooLarge, "the map in slot " + std::to_string(one.slot) + " has ids that are too large");
    }
  }
  for (const MapRelation& relation : relations_) {
    const LineMap* a = map_of(relation.slot_a);
    const LineMap* b = map_of(relation.slot_b);
    const bool known = a != nullptr && b != nullptr && relation.slot_a != relation.slot_b &&
                       std::all_of(relation.pairs.begin(), relation.pairs.end(), [&](const NodeRelation& pair) {
                         return find_node(*a, pair.node_a) != nullptr && find_node(*b, pair.node_b) != nullptr;
                       });
    if (!known) {
      return fail(Errc::kInvalidArgument, "a relation names a robot or a local map that is not there");
    }
  }
  return {};
}

Pose2 Joiner::guess_of(const MapRelation& relation) const {
  std::vector<PairPlace> places;
  places.reserve(relation.pairs.size());
  for (const NodeRelation& pair : relation.pairs) {
    places.push_back(pair_place(pair.a_T_b, find_node(*map_of(relation.slot_a), pair.node_a)->map_T_node,
                                find_node(*map_of(relation.slot_b), pair.node_b)->map_T_node));
  }
  return fuse(places, {}).a_T_b;  // to begin with; the graph decides
}

void Joiner::spread() {
  start_[maps_.front().slot] = {};
  std::deque<std::uint8_t> open{maps_.front().slot};
  while (!open.empty()) {
    const std::uint8_t slot = open.front();
    open.pop_front();
    for (const MapRelation& relation : relations_) {
      if (relation.pairs.empty() || (relation.slot_a != slot && relation.slot_b != slot)) {
        continue;
      }
      const bool forward = relation.slot_a == slot;
      const std::uint8_t other = forward ? relation.slot_b : relation.slot_a;
      const Pose2 step = forward ? guess_of(relation) : inverse(guess_of(relation));
      if (start_.try_emplace(other, start_.at(slot) * step).second) {
        open.push_back(other);
      }
    }
  }
}

Status Joiner::add_relations() {
  for (std::size_t r = 0; r < relations_.size(); ++r) {
    const MapRelation& relation = relations_[r];
    if (!nodes_.contains(relation.slot_a) || !nodes_.contains(relation.slot_b)) {
      continue;
    }
    for (std::size_t k = 0; k < relation.pairs.size(); ++k) {
      const NodeRelation& pair = relation.pairs[k];
      const auto added = graph_.add_edge({.i = nodes_.at(relation.slot_a).at(pair.node_a),
                                          .j = nodes_.at(relation.slot_b).at(pair.node_b),
                                          .i_T_j = pair.a_T_b.a_T_b,
                                          .information = slam::information_of(pair.a_T_b.covariance),
                                          .kernel = slam::EdgeKernel::kSwitchable,
                                          .kernel_width = params_.kernel_width});
      if (!added) {
        return tl::unexpected<Error>(added.error());
      }
      added_.push_back({*added, {r, k}});
    }
  }
  return {};
}

Status Joiner::build() {
  std::vector<const LineMap*> joined;
  joined.reserve(start_.size());
  for (const auto& [slot, joint_T_map] : start_) {
    joined.push_back(map_of(slot));
  }
  const double variance = variance_factor(joined);
  for (const auto& [slot, joint_T_map] : start_) {
    Result<GraphNodes> added = add_map(graph_, *map_of(slot), joint_T_map, variance, params_.kernel_width);
    if (!added) {
      return tl::unexpected<Error>(added.error());
    }
    nodes_[slot] = *std::move(added);
  }
  graph_.fix(nodes_.at(maps_.front().slot).begin()->second);
  return add_relations();
}

JointRobot Joiner::robot_of(std::uint8_t slot) {
  JointRobot robot;
  for (const MapNode& node : map_of(slot)->nodes) {
    robot.nodes[node.id] = {node.map_T_node, graph_.pose(nodes_.at(slot).at(node.id))};
  }
  robot.joint_T_map = rigid_pose(*map_of(slot), [&robot](std::uint32_t id) { return robot.nodes.at(id).joint_T_node; });
  const std::size_t main = nodes_.at(maps_.front().slot).begin()->second;
  const std::size_t first = nodes_.at(slot).begin()->second;
  robot.main_T_first.a_T_b = inverse(graph_.pose(main)) * graph_.pose(first);
  if (first == main) {
    return robot;
  }
  if (const Result<Matrix3> covariance = graph_.relative_covariance(main, first)) {
    robot.main_T_first.covariance = *covariance;
  }
  return robot;
}

void Joiner::append(std::uint8_t slot, const JointRobot& robot, LineMap& whole) const {
  const LineMap& map = *map_of(slot);
  for (const MapNode& node : map.nodes) {
    whole.nodes.push_back({joint_node_id(slot, node.id), robot.nodes.at(node.id).joint_T_node, node.created});
  }
  for (MapEdge edge : map.edges) {
    edge.from = joint_node_id(slot, edge.from);
    edge.to = joint_node_id(slot, edge.to);
    whole.edges.push_back(edge);
  }
  for (MapSegment segment : map.segments) {
    const JointRobot::Node& node = robot.nodes.at(segment.node);
    segment.map_T_segment = node.joint_T_node * inverse(node.map_T_node) * segment.map_T_segment;
    segment.id = joint_segment_id(slot, segment.id);
    segment.node = joint_node_id(slot, segment.node);
    whole.segments.push_back(segment);
  }
  for (const MapKeyframe& keyframe : map.keyframes) {
    whole.keyframes.push_back(keyframe);
    whole.keyframes.back().node = joint_node_id(slot, keyframe.node);
  }
  whole.next_id = std::max(whole.next_id, joint_segment_id(slot, map.next_id - 1) + 1);
}

void Joiner::append_relations(LineMap& whole) const {
  for (const Added& added : added_) {
    const MapRelation& relation = relations_[added.where.relation];
    const NodeRelation& pair = relation.pairs[added.where.pair];
    whole.edges.push_back({joint_node_id(relation.slot_a, pair.node_a), joint_node_id(relation.slot_b, pair.node_b),
                           pair.a_T_b.a_T_b, pair.a_T_b.covariance, true, true});
  }
}

JointMap Joiner::result(std::uint32_t epoch) {
  constexpr double kSwitchedOff = 0.25;  // of its weight left
  JointMap joint;
  joint.map.epoch = epoch;
  for (const auto& [slot, unused] : start_) {
    joint.robots[slot] = robot_of(slot);
    append(slot, joint.robots.at(slot), joint.map);
  }
  append_relations(joint.map);
  joint.pairs = added_.size();
  for (const Added& added : added_) {
    if (graph_.edge_weight(added.edge) < kSwitchedOff) {
      joint.switched_off.push_back(added.where);
    }
  }
  return joint;
}

/// The robot's local map nearest to a place, by the pose that `frame` names.
const JointRobot::Node& nearest_node(const JointRobot& robot, const Pose2& place, Pose2 JointRobot::Node::*frame) {
  const auto nearest = std::min_element(robot.nodes.begin(), robot.nodes.end(), [&](const auto& p, const auto& q) {
    return distance_m(p.second.*frame, place) < distance_m(q.second.*frame, place);
  });
  return nearest->second;
}

}  // namespace

std::uint32_t joint_node_id(std::uint8_t slot, std::uint32_t node) {
  return (static_cast<std::uint32_t>(slot) << kNodeBits) | node;
}

std::uint64_t joint_segment_id(std::uint8_t slot, std::uint64_t segment) {
  return (static_cast<std::uint64_t>(slot) << kSegmentBits) | segment;
}

Origin origin_of_node(std::uint32_t joint_id) {
  return {static_cast<std::uint8_t>(joint_id >> kNodeBits), joint_id & (kMaxJointNodes - 1)};
}

Origin origin_of_segment(std::uint64_t joint_id) {
  return {static_cast<std::uint8_t>(joint_id >> kSegmentBits), joint_id & (kMaxJointSegments - 1)};
}

LineMap as_one_robots(LineMap map) {
  std::uint32_t next_node = 0;
  for (const MapNode& node : map.nodes) {
    next_node = origin_of_node(node.id).slot == 0 ? std::max(next_node, node.id + 1) : next_node;
  }
  std::map<std::uint32_t, std::uint32_t> renamed;
  for (MapNode& node : map.nodes) {
    if (origin_of_node(node.id).slot != 0) {
      node.id = renamed.try_emplace(node.id, next_node + static_cast<std::uint32_t>(renamed.size())).first->second;
    }
  }
  const auto rename = [&renamed](std::uint32_t& node) {
    const auto found = renamed.find(node);
    node = found == renamed.end() ? node : found->second;
  };
  for (MapEdge& edge : map.edges) {
    rename(edge.from);
    rename(edge.to);
  }
  for (MapKeyframe& keyframe : map.keyframes) {
    rename(keyframe.node);
  }
  std::uint64_t next_segment = 1;
  for (const MapSegment& segment : map.segments) {
    next_segment = origin_of_segment(segment.id).slot == 0 ? std::max(next_segment, segment.id + 1) : next_segment;
  }
  for (MapSegment& segment : map.segments) {
    rename(segment.node);
    segment.id = origin_of_segment(segment.id).slot == 0 ? segment.id : next_segment++;
  }
  map.next_id = map.next_id > kMaxJointSegments ? next_segment : map.next_id;
  return map;
}

Pose2 JointRobot::to_joint(const Pose2& map_T_x) const {
  const Node& node = nearest_node(*this, map_T_x, &Node::map_T_node);
  return node.joint_T_node * inverse(node.map_T_node) * map_T_x;
}

Pose2 JointRobot::from_joint(const Pose2& joint_T_x) const {
  const Node& node = nearest_node(*this, joint_T_x, &Node::joint_T_node);
  return node.map_T_node * inverse(node.joint_T_node) * joint_T_x;
}

Result<JointMap> join(const std::vector<RobotMap>& maps, const std::vector<MapRelation>& relations, std::uint32_t epoch,
                      const JointParams& params) {
  Joiner joiner(maps, relations, params);
  if (Status ok = joiner.check(); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  joiner.spread();
  if (Status built = joiner.build(); !built) {
    return tl::unexpected<Error>(built.error());
  }
  if (Status optimised = joiner.optimise(); !optimised) {
    return tl::unexpected<Error>(optimised.error());
  }
  return joiner.result(epoch);
}

}  // namespace seeker::fleet
