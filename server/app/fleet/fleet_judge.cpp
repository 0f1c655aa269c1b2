#include "server/app/fleet/fleet_judge.hpp"

#include <algorithm>
#include <future>
#include <memory>
#include <utility>

#include "server/fleet/merge_memory.hpp"

namespace seeker::app {
namespace {

/// Wall time for the loop to hand its map over.
constexpr std::chrono::seconds kOwnMapLimit{20};

const MapKeyframe* first_keyframe(const LineMap& map, std::uint32_t node) {
  const auto keyframe = std::find_if(map.keyframes.begin(), map.keyframes.end(),
                                     [node](const MapKeyframe& one) { return one.node == node; });
  return keyframe == map.keyframes.end() ? nullptr : &*keyframe;
}

/// Whether one map has grown from the other: it has begun anew where no local map is where it was. Every map begins
/// with the same number at the origin, but no two scans of a laser are the same.
bool same_map(const LineMap& before, const LineMap& now) {
  return std::any_of(before.nodes.begin(), before.nodes.end(), [&](const MapNode& one) {
    const MapKeyframe* keyframe = first_keyframe(before, one.id);
    return keyframe != nullptr && std::any_of(now.nodes.begin(), now.nodes.end(), [&](const MapNode& other) {
             const MapKeyframe* same = one.id == other.id ? first_keyframe(now, other.id) : nullptr;
             return same != nullptr && *same == *keyframe && fleet::same_place(one.map_T_node, other.map_T_node);
           });
  });
}

}  // namespace

FleetJudge::FleetJudge(const fleet::MergeParams& params, Duration retry_period, MemberBook& book, OwnRobot& main,
                       GiveMap give_map)
    : book_(book), main_(main), give_map_(std::move(give_map)), pairs_(params, retry_period) {}

void FleetJudge::recall(RememberedFleet remembered) {
  joint_epoch_ = remembered.joint_epoch;
  if (!remembered.own_map ||
      !pairs_.update(kMainSlot, std::move(*remembered.own_map), std::move(remembered.own_pictures))) {
    return;
  }
  main_.recall(pairs_.map(kMainSlot), remembered.own_topology, std::move(remembered.own_finds));
  for (MemberMap& member : book_.maps()) {
    if (take(member)) {
      judged_nodes_[member.slot] = std::move(member.manifest.nodes);
    }
  }
  const WallTime now = std::chrono::steady_clock::now();
  for (fleet::PairAnswer& pair : remembered.pairs) {
    pairs_.recall(std::move(pair), now);
  }
  join_all();
}

void FleetJudge::judge(const std::string& robot_id) {
  if (const std::optional<MemberMap> member = book_.begin_judgement(robot_id, std::chrono::steady_clock::now())) {
    std::vector<api::FleetNode>& before = judged_nodes_[member->slot];
    if (!same_frame(before, member->manifest.nodes)) {
      pairs_.forget_map(member->slot);
    }
    before = member->manifest.nodes;
    const Status compared = compare(*member);
    book_.set_trouble(robot_id, compared ? "" : compared.error().message);
  }
  join_all();
}

Result<OwnMap> FleetJudge::ask_own_map() const {
  auto promise = std::make_shared<std::promise<Result<OwnMap>>>();
  std::future<Result<OwnMap>> future = promise->get_future();
  give_map_([promise](Result<OwnMap> own) { promise->set_value(std::move(own)); });
  if (future.wait_for(kOwnMapLimit) != std::future_status::ready) {
    return fail(Errc::kTimeout, "the main robot's loop does not hand its map over");
  }
  return future.get();
}

/// The main robot's own map as it is now; as it was, while the robot has not taken it up again after a restart.
Status FleetJudge::take_own_map(Result<OwnMap> own) {
  const LineMap& before = pairs_.map(kMainSlot);
  const bool new_map = own && !same_map(before, own->map);
  const bool nothing_yet = !own || (new_map && own->map.keyframes.size() <= 1);  // it has not even moved
  if (nothing_yet && !before.nodes.empty()) {
    main_.keep_remembered();
    return {};
  }
  if (!own) {
    return fail_with_context("the main robot has no map yet", own.error());
  }
  main_.take_map(*own, new_map && !before.nodes.empty());
  if (new_map) {
    pairs_.forget_map(kMainSlot);
  }
  return pairs_.update(kMainSlot, std::move(own->map), std::move(own->pictures));
}

Status FleetJudge::take(const MemberMap& member) {
  Result<LineMap> map = unpack_map(member.manifest, member.pieces);
  if (!map) {
    return tl::unexpected<Error>(map.error());
  }
  Result<fleet::NodePictures> pictures = unpack_pictures(member.manifest, member.pieces);
  if (!pictures) {
    return tl::unexpected<Error>(pictures.error());
  }
  return pairs_.update(member.slot, std::move(*map), std::move(*pictures));
}

Status FleetJudge::compare(const MemberMap& member) {
  if (Status ready = take_own_map(ask_own_map()); !ready) {
    return ready;
  }
  if (Status ready = take(member); !ready) {
    return ready;
  }
  pairs_.mark_stale();
  pairs_.compare(kMainSlot, member.slot);
  compare_with_others(member.slot);
  return {};
}

/// A robot that shares nothing with the main one may share something with another one; and where both share something
/// with the main one, the loop over the three maps must close.
void FleetJudge::compare_with_others(std::uint8_t slot) {
  const WallTime now = std::chrono::steady_clock::now();
  for (const std::uint8_t other : book_.comparable_but(slot)) {
    if (pairs_.contains(other)) {
      const auto [a, b] = std::minmax(slot, other);
      pairs_.compare_aged(a, b, now);
    }
  }
}

void FleetJudge::join_all() {
  JoinOutcome outcome;
  outcome.pairs = book_.taking_part(pairs_.fresh_answers());
  fleet::demote_open_cycles(outcome.pairs);
  outcome.links = fleet::links_from(kMainSlot, outcome.pairs);
  joint_.reset();
  if (!outcome.links.empty()) {
    Result<fleet::JointMap> joint = join(outcome);
    if (joint) {
      joint_ = std::move(*joint);
      outcome.main_T_maps.emplace();
      for (const auto& [slot, robot] : joint_->robots) {
        outcome.main_T_maps->emplace(slot, robot.joint_T_map);
      }
    } else {
      outcome.trouble = joint.error().message;
    }
  }
  book_.settle(outcome);
}

Result<fleet::JointMap> FleetJudge::join(const JoinOutcome& outcome) {
  std::vector<fleet::RobotMap> maps{{kMainSlot, &pairs_.map(kMainSlot)}};
  maps.reserve(outcome.links.size() + 1);
  for (const auto& [slot, link] : outcome.links) {
    maps.push_back({slot, &pairs_.map(slot)});
  }
  std::vector<fleet::MapRelation> relations = fleet::relations_of(outcome.pairs);
  const auto takes_part = [&](std::uint8_t slot) { return slot == kMainSlot || outcome.links.contains(slot); };
  std::erase_if(relations, [&](const fleet::MapRelation& relation) {
    return !takes_part(relation.slot_a) || !takes_part(relation.slot_b);
  });
  return fleet::join(maps, relations, ++joint_epoch_);
}

JudgedFleet FleetJudge::judged() const {
  return {&pairs_.map(kMainSlot), &pairs_.pictures(kMainSlot), pairs_.version(kMainSlot), joint_epoch_,
          pairs_.all_answers()};
}

}  // namespace seeker::app
