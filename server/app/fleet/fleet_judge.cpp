// How the main robot judges the maps of the others, on its worker (FleetLeader).

#include <algorithm>
#include <future>
#include <utility>

#include "common/log/log.hpp"
#include "server/app/fleet/fleet_leader.hpp"
#include "server/app/fleet/fleet_settings.hpp"
#include "server/fleet/merge_memory.hpp"
#include "server/store/map_file.hpp"

namespace seeker::app {
namespace {

/// Wall time for the loop to hand its map over.
constexpr std::chrono::seconds kOwnMapLimit{20};
constexpr std::uint8_t kMainSlot = 0;

api::FleetState state_of(fleet::MergeVerdict verdict) {
  switch (verdict) {
    case fleet::MergeVerdict::kMerged: return api::FleetState::kMerged;
    case fleet::MergeVerdict::kAmbiguous: return api::FleetState::kAmbiguous;
    case fleet::MergeVerdict::kContradicted: return api::FleetState::kContradicted;
    case fleet::MergeVerdict::kInsufficientOverlap: return api::FleetState::kInsufficientOverlap;
  }
  return api::FleetState::kInsufficientOverlap;
}

const MapKeyframe* first_scan(const LineMap& map, std::uint32_t node) {
  const auto scan = std::find_if(map.keyframes.begin(), map.keyframes.end(),
                                 [node](const MapKeyframe& keyframe) { return keyframe.node == node; });
  return scan == map.keyframes.end() ? nullptr : &*scan;
}

/// Whether one map has grown from the other: it has begun anew where no local map is where it was. Every map begins
/// with the same number at the origin, but no two scans of a laser are the same.
bool same_map(const LineMap& before, const LineMap& now) {
  return std::any_of(before.nodes.begin(), before.nodes.end(), [&](const MapNode& one) {
    const MapKeyframe* scan = first_scan(before, one.id);
    return scan != nullptr && std::any_of(now.nodes.begin(), now.nodes.end(), [&](const MapNode& other) {
             const MapKeyframe* same = one.id == other.id ? first_scan(now, other.id) : nullptr;
             return same != nullptr && *same == *scan && fleet::same_place(one.map_T_node, other.map_T_node);
           });
  });
}

std::vector<Point2> places_of(const LineMap& map) {
  std::vector<Point2> places;
  places.reserve(map.nodes.size());
  for (const MapNode& node : map.nodes) {
    places.push_back(node.map_T_node.translation());
  }
  return places;
}

}  // namespace

bool same_frame(const std::vector<api::FleetNode>& a, const std::vector<api::FleetNode>& b) {
  return std::any_of(a.begin(), a.end(), [&](const api::FleetNode& one) {
    return std::any_of(b.begin(), b.end(), [&](const api::FleetNode& other) {
      return one.node.id == other.node.id && one.hash == other.hash &&
             fleet::same_place(one.node.map_T_node, other.node.map_T_node);
    });
  });
}

Result<OwnMap> FleetLeader::ask_own_map() {
  auto promise = std::make_shared<std::promise<Result<OwnMap>>>();
  std::future<Result<OwnMap>> future = promise->get_future();
  host_.give_map([promise](Result<OwnMap> own) { promise->set_value(std::move(own)); });
  if (future.wait_for(kOwnMapLimit) != std::future_status::ready) {
    return fail(Errc::kTimeout, "the main robot's loop does not hand its map over");
  }
  return future.get();
}

void FleetLeader::judge(const std::string& robot_id) {
  api::FleetManifest manifest;
  Pieces pieces;
  std::uint8_t slot = kMainSlot;
  {
    const std::lock_guard lock(mutex_);
    Member& member = members_.at(robot_id);
    member.waits = false;
    if (missing_of(member).empty()) {
      member.judged = std::chrono::steady_clock::now();
      member.begun_anew = false;
      manifest = member.manifest;
      pieces = member.pieces;
      slot = member.slot;
    }
  }
  // One that has announced more meanwhile is judged when that is here; until then what was found holds.
  if (slot != kMainSlot) {
    std::erase_if(pairs_, [&](const auto& pair) {
      return (pair.first.first == slot || pair.first.second == slot) && !same_frame(judged_[slot], manifest.nodes);
    });
    judged_[slot] = manifest.nodes;
    Result<LineMap> map = unpack_map(manifest, pieces);
    const Status compared = map ? compare(slot, std::move(*map)) : tl::unexpected<Error>(map.error());
    const std::lock_guard lock(mutex_);
    members_.at(robot_id).trouble = compared ? "" : compared.error().message;
  }
  join_all();
  keep_memory();
}

Status FleetLeader::prepare(std::uint8_t slot, LineMap map) {
  fleet::PreparedMap& prepared = prepared_[slot];
  if (prepared.map() == map) {
    return {};
  }
  ++versions_[slot];
  return prepared.update(std::move(map));
}

/// The main robot's own map as it is now; as it was, while the robot has not taken it up again after a restart.
Status FleetLeader::take_own_map(Result<OwnMap> own) {
  const LineMap& before = prepared_[kMainSlot].map();
  const bool new_map = own && !same_map(before, own->map);
  const bool nothing_yet = !own || (new_map && own->map.keyframes.size() <= 1);  // it has not even moved
  if (nothing_yet && !before.nodes.empty()) {
    const std::lock_guard lock(mutex_);
    remembers_own_ = true;
    return {};
  }
  if (!own) {
    return fail_with_context("the main robot has no map yet", own.error());
  }
  {
    const std::lock_guard lock(mutex_);
    own_map_T_base_ = own->map_T_base;
    own_places_ = places_of(own->map);
    if (new_map && !before.nodes.empty()) {
      forget_own();
    }
    remembers_own_ = false;
  }
  if (new_map) {
    std::erase_if(pairs_, [](const auto& pair) { return pair.first.first == kMainSlot; });
  }
  if (Status ready = prepare(kMainSlot, std::move(own->map)); !ready) {
    return ready;
  }
  keep_own_pieces();
  return {};
}

/// Places in a map that is no more; those of the new one are told soon.
void FleetLeader::forget_own() {
  Told before = std::exchange(own_told_, {});
  if (!remembers_own_) {
    own_told_.topology = std::move(before.topology);  // the loop has told it since
  }
}

Status FleetLeader::compare(std::uint8_t slot, LineMap map) {
  if (Status ready = take_own_map(ask_own_map()); !ready) {
    return ready;
  }
  if (Status ready = prepare(slot, std::move(map)); !ready) {
    return ready;
  }
  for (auto& [slots, compared] : pairs_) {
    compared.stale =
        compared.stale || !fleet::holds(compared.answer, prepared_.at(slots.first), prepared_.at(slots.second));
  }
  compare(kMainSlot, slot);
  compare_with_others(slot);
  return {};
}

void FleetLeader::compare(std::uint8_t a, std::uint8_t b) {
  const std::pair versions{versions_[a], versions_[b]};
  const auto before = pairs_.find({a, b});
  if (before != pairs_.end() && !before->second.stale && before->second.versions == versions) {
    return;  // nothing has changed since
  }
  fleet::MergeAnswer answer = merger_.merge(prepared_.at(a), prepared_.at(b));
  if (before != pairs_.end()) {
    fleet::judge_again(answer, before->second.answer, params_.merge);
  }
  pairs_[{a, b}] = {std::move(answer), std::chrono::steady_clock::now(), versions};
}

/// A robot that shares nothing with the main one may share something with another one; and where both share something
/// with the main one, the three must close. Asked again only after a while: some of many robots change all the time.
void FleetLeader::compare_with_others(std::uint8_t slot) {
  std::vector<std::uint8_t> others;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& [id, member] : members_) {
      if (member.slot != slot && !member.split && member.trouble.empty() && prepared_.contains(member.slot)) {
        others.push_back(member.slot);
      }
    }
  }
  const WallTime now = std::chrono::steady_clock::now();
  for (const std::uint8_t other : others) {
    const auto [a, b] = std::minmax(slot, other);
    const auto known = pairs_.find({a, b});
    if (known == pairs_.end() || known->second.stale || now - known->second.at > params_.retry_period) {
      compare(a, b);
    }
  }
}

/// What the merger says of the robots that take part, with the operator's word.
std::vector<fleet::PairAnswer> FleetLeader::pairs_now() {
  const std::lock_guard lock(mutex_);
  std::map<std::uint8_t, Member*> of_slot;
  for (auto& [id, member] : members_) {
    if (!member.split && !member.begun_anew && member.trouble.empty()) {
      of_slot[member.slot] = &member;
    }
  }
  std::vector<fleet::PairAnswer> pairs;
  for (const auto& [slots, compared] : pairs_) {
    const auto [a, b] = slots;
    if (!compared.stale && (a == kMainSlot || of_slot.contains(a)) && of_slot.contains(b)) {
      pairs.push_back({a, b, compared.answer});
      if (a == kMainSlot && of_slot.at(b)->accepted) {
        obey_operator(*of_slot.at(b), pairs.back().answer);
      }
    }
  }
  return pairs;
}

void FleetLeader::obey_operator(Member& member, fleet::MergeAnswer& answer) {
  const auto same = std::find_if(answer.hypotheses.begin(), answer.hypotheses.end(),
                                 [&](const auto& one) { return fleet::same_place(one.a_T_b.a_T_b, *member.accepted); });
  if (same == answer.hypotheses.end() || answer.verdict == fleet::MergeVerdict::kContradicted) {
    answer.verdict = fleet::MergeVerdict::kContradicted;
    answer.reason = "what was accepted does not fit what the robots have seen since: " + answer.reason;
    member.accepted.reset();
    return;
  }
  std::rotate(answer.hypotheses.begin(), same, same + 1);
  answer.verdict = fleet::MergeVerdict::kMerged;
  answer.reason = "accepted by the operator";
}

void FleetLeader::join_all() {
  Round round;
  round.pairs = pairs_now();
  fleet::demote_open_cycles(round.pairs);
  round.links = fleet::links_from(kMainSlot, round.pairs);
  joint_.reset();
  if (!round.links.empty()) {
    Result<fleet::JointMap> joint = join(round);
    if (joint) {
      joint_ = std::move(*joint);
    } else {
      round.trouble = joint.error().message;
    }
  }
  const std::lock_guard lock(mutex_);
  for (const auto& [id, member] : members_) {
    round.names[member.slot] = id;
  }
  for (auto& [id, member] : members_) {
    settle(member, round);
  }
}

Result<fleet::JointMap> FleetLeader::join(const Round& round) {
  std::vector<fleet::RobotMap> maps{{kMainSlot, &prepared_.at(kMainSlot).map()}};
  maps.reserve(round.links.size() + 1);
  for (const auto& [slot, link] : round.links) {
    maps.push_back({slot, &prepared_.at(slot).map()});
  }
  std::vector<fleet::MapRelation> relations = fleet::relations_of(round.pairs);
  const auto takes_part = [&](std::uint8_t slot) { return slot == kMainSlot || round.links.contains(slot); };
  std::erase_if(relations, [&](const fleet::MapRelation& relation) {
    return !takes_part(relation.slot_a) || !takes_part(relation.slot_b);
  });
  return fleet::join(maps, relations, ++joint_epoch_);
}

/// State, reason and place of a robot from what was found this time.
void FleetLeader::settle(Member& member, const Round& round) {
  const auto pair = std::find_if(round.pairs.begin(), round.pairs.end(), [&](const fleet::PairAnswer& one) {
    return one.slot_a == kMainSlot && one.slot_b == member.slot;
  });
  member.confidence = 0.0;
  if (member.split) {
    set_state(member, api::FleetState::kSplit, kSplitReason);
    return;
  }
  member.hypotheses.clear();
  if (!member.trouble.empty() || pair == round.pairs.end()) {
    set_state(member, api::FleetState::kWaiting, member.trouble.empty() ? member.reason : member.trouble);
    return;
  }
  member.hypotheses = pair->answer.hypotheses;
  member.confidence = pair->answer.confidence();
  const auto link = round.links.find(member.slot);
  if (link == round.links.end()) {
    set_state(member, state_of(pair->answer.verdict), pair->answer.reason);
    return;
  }
  const auto placed = joint_ ? joint_->robots.find(member.slot) : decltype(joint_->robots.end()){};
  if (!joint_ || placed == joint_->robots.end()) {
    set_state(member, api::FleetState::kAmbiguous, joint_ ? "the other robots' maps outvote it" : round.trouble);
    return;
  }
  member.main_T_map = placed->second.joint_T_map;
  member.confidence = link->second.confidence;
  set_state(member, api::FleetState::kMerged,
            link->second.through == kMainSlot
                ? pair->answer.reason
                : "merged with the map of robot '" + round.names.at(link->second.through) +
                      "', not with that of the main one: " + pair->answer.reason);
}

void FleetLeader::set_state(Member& member, api::FleetState state, std::string reason) {
  member.reason = std::move(reason);
  if (member.state == state) {
    return;
  }
  member.state = state;
  ++revision_;
  const std::string& id = member.manifest.robot_id;
  const std::string text = "robot '" + id + "' is " + std::string(api::to_string(state)) + ": " + member.reason;
  log::info(kFleetPart, text);
  if (state == api::FleetState::kAmbiguous) {
    host_.tell_operator("fleet-ambiguous",
                        text + "; 'seeker fleet status' shows the ways to lay its map, 'seeker fleet merge " + id +
                            " --hypothesis N' accepts one",
                        api::Severity::kWarning);
  } else if (state == api::FleetState::kContradicted) {
    host_.tell_operator("fleet-contradicted", text, api::Severity::kWarning);
  }
}

void FleetLeader::map(const api::Reply<std::vector<std::uint8_t>>& reply) {
  const Status posted = worker_.post([this, reply] {
    store::MapFile file;
    file.origin.name = "fleet";
    file.origin.robot_id = params_.robot_id;
    file.origin.software_version = params_.software_version;
    file.origin.saved_unix_s = wall_unix_s();
    file.origin.created_unix_s = file.origin.saved_unix_s;
    if (!joint_) {
      reply(fail(Errc::kNotReady, "no robot's map is merged with this one's yet; 'seeker fleet status' tells why"));
      return;
    }
    file.map = joint_->map;
    store::MapFileLimits limits;
    limits.file_bytes = api::kMaxMapTransferBytes;
    reply(store::encode_map_file(file, limits));
  });
  if (!posted) {
    reply(tl::unexpected<Error>(posted.error()));
  }
}

}  // namespace seeker::app
