// What the main robot knows of all maps together, and has again after a restart (FleetLeader).

#include <algorithm>
#include <set>
#include <utility>

#include "common/log/log.hpp"
#include "common/wire/convert.hpp"
#include "common/wire/convert_fleet.hpp"
#include "common/wire/fleet_fields.hpp"
#include "seeker/v1/kept.pb.h"
#include "server/app/fleet/fleet_leader.hpp"
#include "server/app/fleet/fleet_records.hpp"
#include "server/app/fleet/fleet_settings.hpp"
#include "server/app/state/kept_message.hpp"
#include "server/fleet/merge_memory.hpp"

namespace seeker::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMemoryFile = "memory";
constexpr const char* kMemoryKind = "fleet";
constexpr std::size_t kMaxMemoryBytes = 64UL << 20U;
constexpr std::uint8_t kMainSlot = 0;

}  // namespace

void FleetLeader::load() {
  auto kept = read_kept_message<v1::KeptFleet>(params_.folder / kMemoryFile, kMemoryKind, kMaxMemoryBytes);
  if (!kept && kept.error().code != Errc::kNotFound) {
    tell_damage("how the maps lie to each other has to be found anew: " + kept.error().message);
  }
  if (kept) {
    load_slots(*kept);
  }
  std::error_code error;
  std::set<fs::path> folders;  // in the same order on every disk
  for (const fs::directory_entry& entry : fs::directory_iterator(params_.folder, error)) {
    if (entry.is_directory() && entry.path().filename() != params_.robot_id) {
      folders.insert(entry.path());
    }
  }
  for (const fs::path& folder : folders) {
    load_member(folder);
  }
  // What was found is laid out first, so that nobody who asks meanwhile is told that nothing is known.
  if (kept) {
    static_cast<void>(
        worker_.post([this, memory = std::make_shared<v1::KeptFleet>(std::move(*kept))] { recall(*memory); }));
  }
  const std::lock_guard lock(mutex_);
  for (auto& [id, member] : members_) {
    if (missing_of(member).empty()) {
      ask_for_judgement(id, member);
    }
  }
}

void FleetLeader::load_slots(const v1::KeptFleet& kept) {
  std::set<std::uint32_t> taken{kMainSlot};
  for (const v1::KeptSlot& slot : kept.slots()) {
    if (slot.slot() < api::kMaxFleetRobots && taken.insert(slot.slot()).second) {
      kept_slots_[slot.robot_id()] = static_cast<std::uint8_t>(slot.slot());
    }
  }
}

/// The one that it had; else the lowest that no robot has had.
std::uint8_t FleetLeader::free_slot(const std::string& robot_id) const {
  if (const auto kept = kept_slots_.find(robot_id); kept != kept_slots_.end()) {
    return kept->second;
  }
  std::set<std::uint8_t> taken;
  for (const auto& [id, member] : members_) {
    if (id != robot_id) {
      taken.insert(member.slot);
    }
  }
  const auto lowest = [&] {
    std::uint8_t slot = kMainSlot + 1;
    while (taken.contains(slot)) {
      ++slot;
    }
    return slot;
  };
  const std::uint8_t fallback = lowest();  // of a robot that is no more, where sixteen have been
  for (const auto& [id, slot] : kept_slots_) {
    taken.insert(slot);
  }
  const std::uint8_t unused = lowest();
  return unused < api::kMaxFleetRobots ? unused : fallback;
}

/// Everything as it was when it was written, without asking the main robot, whose map is perhaps not there yet.
void FleetLeader::recall(const v1::KeptFleet& kept) {
  joint_epoch_ = kept.joint_epoch();
  if (!recall_maps(kept)) {
    return;
  }
  recall_pairs(kept);
  join_all();
}

bool FleetLeader::recall_maps(const v1::KeptFleet& kept) {
  const Result<api::FleetManifest> own = wire::from_message<api::FleetManifest>(kept.own());
  const Pieces pieces = own ? load_pieces(params_.folder / params_.robot_id, *own) : Pieces{};
  Result<LineMap> map = own ? unpack_map(*own, pieces) : Result<LineMap>(tl::unexpected<Error>(own.error()));
  const Status ready = map ? prepare(kMainSlot, std::move(*map)) : Status(tl::unexpected<Error>(map.error()));
  if (!ready) {
    tell_damage("how the maps lie to each other has to be found anew, the main robot's own is not there any more: " +
                ready.error().message);
    return false;
  }
  own_packed_ = {*own, pieces};
  own_packed_of_ = versions_[kMainSlot];
  std::map<std::uint8_t, std::pair<api::FleetManifest, Pieces>> sent;
  {
    const std::lock_guard lock(mutex_);
    recall_own(*own, kept);
    for (const auto& [id, member] : members_) {
      sent[member.slot] = {member.manifest, member.pieces};
    }
  }
  for (const auto& [slot, robot] : sent) {
    Result<LineMap> theirs = unpack_map(robot.first, robot.second);
    if (theirs && prepare(slot, std::move(*theirs))) {
      judged_[slot] = robot.first.nodes;
    }
  }
  return true;
}

void FleetLeader::recall_own(const api::FleetManifest& own, const v1::KeptFleet& kept) {
  remembers_own_ = true;
  for (const api::FleetNode& node : own.nodes) {
    own_places_.push_back(node.node.map_T_node.translation());
  }
  if (Result<RobotTopology> topology = wire::from_message<RobotTopology>(kept.own_topology())) {
    own_told_.topology = std::move(*topology);
    own_told_.topology->velocity.reset();
    own_told_.topology->active = false;
  }
  own_told_.finds.before = load_found(kept.own_detections(), params_.robot_id);
}

void FleetLeader::recall_pairs(const v1::KeptFleet& kept) {
  const auto slot_of = [&](const std::string& id) -> std::optional<std::uint8_t> {
    const auto known = kept_slots_.find(id);
    const std::optional<std::uint8_t> slot = id == params_.robot_id       ? std::optional<std::uint8_t>(kMainSlot)
                                             : known == kept_slots_.end() ? std::nullopt
                                                                          : std::optional(known->second);
    return slot && prepared_.contains(*slot) ? slot : std::nullopt;
  };
  for (const v1::KeptPair& pair : kept.pairs()) {
    const auto a = slot_of(pair.robot_a());
    const auto b = slot_of(pair.robot_b());
    Result<fleet::MergeAnswer> answer = read_answer(pair);
    if (!answer) {
      tell_damage("how the maps of '" + pair.robot_a() + "' and '" + pair.robot_b() +
                  "' lie has to be found anew: " + answer.error().message);
    } else if (a && b && *a < *b) {
      const bool stale = !fleet::holds(*answer, prepared_.at(*a), prepared_.at(*b));
      pairs_[{*a, *b}] = {std::move(*answer), std::chrono::steady_clock::now(), {versions_[*a], versions_[*b]}, stale};
    }
  }
}

/// As pieces, like those of the others: of a map that grows most stay as they are.
void FleetLeader::keep_own_pieces() {
  if (own_packed_of_ == versions_[kMainSlot]) {
    return;
  }
  Result<PackedMap> packed = pack_map(prepared_.at(kMainSlot).map(), params_.robot_id);
  if (!packed) {
    log::warning(kFleetPart, "the main robot's own map is not kept for a restart: " + packed.error().message);
    return;
  }
  for (const auto& [hash, bytes] : packed->pieces) {
    if (!own_packed_.pieces.contains(hash)) {
      keep_piece(params_.robot_id, hash, bytes);
    }
  }
  own_packed_ = std::move(*packed);
  own_packed_of_ = versions_[kMainSlot];
}

void FleetLeader::keep_memory() {
  if (own_packed_.manifest.nodes.empty()) {
    return;  // nothing yet, or what is on disk holds
  }
  v1::KeptFleet kept;
  wire::write(own_packed_.manifest, kept.mutable_own());
  kept.set_joint_epoch(joint_epoch_);
  std::map<std::uint8_t, std::string> names{{kMainSlot, params_.robot_id}};
  {
    const std::lock_guard lock(mutex_);
    if (own_told_.topology) {
      wire::write(api::within_limits(*own_told_.topology), kept.mutable_own_topology());
    }
    wire::write_detections(own_told_.finds.all(), kept.mutable_own_detections());
    for (const auto& [id, member] : members_) {
      kept_slots_[id] = member.slot;
    }
    for (const auto& [id, slot] : kept_slots_) {
      names[slot] = id;
      v1::KeptSlot* one = kept.add_slots();
      one->set_robot_id(id);
      one->set_slot(slot);
    }
  }
  for (const auto& [slots, compared] : pairs_) {
    v1::KeptPair* pair = kept.add_pairs();
    pair->set_robot_a(names[slots.first]);
    pair->set_robot_b(names[slots.second]);
    write(compared.answer, pair);
  }
  std::string bytes = kept.SerializeAsString();
  if (bytes == memory_) {
    return;
  }
  if (const Status written = store::write_sealed_file(params_.folder / kMemoryFile, kMemoryKind, bytes); !written) {
    log::warning(kFleetPart, "how the maps lie is not kept for a restart: " + written.error().message);
    return;
  }
  memory_ = std::move(bytes);
  drop_pieces(params_.robot_id, own_packed_.pieces);
}

}  // namespace seeker::app
