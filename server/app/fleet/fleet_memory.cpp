#include "server/app/fleet/fleet_memory.hpp"

#include <set>
#include <utility>

#include "common/log/log.hpp"
#include "common/wire/convert.hpp"
#include "common/wire/convert_fleet.hpp"
#include "common/wire/fleet_fields.hpp"
#include "server/app/fleet/fleet_settings.hpp"
#include "server/app/state/kept_message.hpp"

namespace seeker::app {
namespace {

constexpr const char* kMemoryFile = "memory";
constexpr const char* kMemoryKind = "fleet";
constexpr std::size_t kMaxMemoryBytes = 64UL << 20U;

}  // namespace

FleetMemory::FleetMemory(std::filesystem::path folder, std::string robot_id, const PieceFiles& pieces,
                         ReportDamage report_damage)
    : folder_(std::move(folder)),
      robot_id_(std::move(robot_id)),
      pieces_(pieces),
      report_damage_(std::move(report_damage)) {}

std::optional<v1::KeptFleet> FleetMemory::read() const {
  auto kept = read_kept_message<v1::KeptFleet>(folder_ / kMemoryFile, kMemoryKind, kMaxMemoryBytes);
  if (!kept) {
    if (kept.error().code != Errc::kNotFound) {
      report_damage_("how the maps lie to each other has to be found anew: " + kept.error().message);
    }
    return std::nullopt;
  }
  return std::move(*kept);
}

FleetSlots FleetMemory::slots_of(const v1::KeptFleet& kept) {
  FleetSlots slots;
  std::set<std::uint32_t> taken{kMainSlot};
  for (const v1::KeptSlot& slot : kept.slots()) {
    if (slot.slot() < api::kMaxFleetRobots && taken.insert(slot.slot()).second) {
      slots.keep(slot.robot_id(), static_cast<std::uint8_t>(slot.slot()));
    }
  }
  return slots;
}

RememberedFleet FleetMemory::recall(const v1::KeptFleet& kept) {
  RememberedFleet fleet;
  fleet.joint_epoch = kept.joint_epoch();
  const Result<api::FleetManifest> own = wire::from_message<api::FleetManifest>(kept.own());
  const Pieces pieces = own ? pieces_.load(*own) : Pieces{};
  Result<LineMap> map = own ? unpack_map(*own, pieces) : Result<LineMap>(tl::unexpected<Error>(own.error()));
  if (!map) {
    report_damage_("how the maps lie to each other has to be found anew, the main robot's own is not there any more: " +
                   map.error().message);
    return fleet;
  }
  packed_ = {*own, pieces};
  fleet.own_map = std::move(*map);
  if (Result<fleet::NodePictures> pictures = unpack_pictures(*own, pieces)) {
    fleet.own_pictures = std::move(*pictures);
  }
  if (Result<RobotTopology> topology = wire::from_message<RobotTopology>(kept.own_topology())) {
    fleet.own_topology = std::move(*topology);
  }
  fleet.own_finds = read_found(kept.own_detections(), robot_id_, report_damage_);
  fleet.pairs = recall_pairs(kept);
  return fleet;
}

std::vector<fleet::PairAnswer> FleetMemory::recall_pairs(const v1::KeptFleet& kept) const {
  const FleetSlots slots = slots_of(kept);
  const auto slot_of = [&](const std::string& id) -> std::optional<std::uint8_t> {
    if (id == robot_id_) {
      return kMainSlot;
    }
    const auto known = slots.kept().find(id);
    return known == slots.kept().end() ? std::nullopt : std::optional(known->second);
  };
  std::vector<fleet::PairAnswer> pairs;
  pairs.reserve(static_cast<std::size_t>(kept.pairs_size()));
  for (const v1::KeptPair& pair : kept.pairs()) {
    const std::optional<std::uint8_t> a = slot_of(pair.robot_a());
    const std::optional<std::uint8_t> b = slot_of(pair.robot_b());
    Result<fleet::MergeAnswer> answer = read_answer(pair);
    if (!answer) {
      report_damage_("how the maps of '" + pair.robot_a() + "' and '" + pair.robot_b() +
                     "' lie has to be found anew: " + answer.error().message);
    } else if (a && b && *a < *b) {
      pairs.push_back({*a, *b, std::move(*answer)});
    }
  }
  return pairs;
}

void FleetMemory::keep_own_map(const LineMap& map, const fleet::NodePictures& pictures, std::uint64_t version) {
  if (packed_version_ == version) {
    return;
  }
  Result<PackedMap> packed = pack_map(map, robot_id_, pictures);
  if (!packed) {
    log::warning(kFleetPart, "the main robot's own map is not kept for a restart: " + packed.error().message);
    return;
  }
  for (const auto& [hash, bytes] : packed->pieces) {
    if (!packed_.pieces.contains(hash)) {
      pieces_.keep(robot_id_, hash, bytes);
    }
  }
  packed_ = std::move(*packed);
  packed_version_ = version;
}

void FleetMemory::keep(const JudgedFleet& judged, const RobotReport& own,
                       const std::map<std::string, std::uint8_t>& slots) {
  keep_own_map(*judged.own_map, *judged.own_pictures, judged.own_version);
  if (packed_.manifest.nodes.empty()) {
    return;  // nothing yet, or what is on disk holds
  }
  v1::KeptFleet kept;
  wire::write(packed_.manifest, kept.mutable_own());
  kept.set_joint_epoch(judged.joint_epoch);
  if (own.topology) {
    wire::write(api::within_limits(*own.topology), kept.mutable_own_topology());
  }
  wire::write_detections(own.finds.all(), kept.mutable_own_detections());
  std::map<std::uint8_t, std::string> names{{kMainSlot, robot_id_}};
  for (const auto& [id, slot] : slots) {
    names[slot] = id;
    v1::KeptSlot* one = kept.add_slots();
    one->set_robot_id(id);
    one->set_slot(slot);
  }
  for (const fleet::PairAnswer& found : judged.pairs) {
    v1::KeptPair* pair = kept.add_pairs();
    pair->set_robot_a(names[found.slot_a]);
    pair->set_robot_b(names[found.slot_b]);
    write(found.answer, pair);
  }
  std::string bytes = kept.SerializeAsString();
  if (bytes == written_) {
    return;
  }
  if (const Status done = store::write_sealed_file(folder_ / kMemoryFile, kMemoryKind, bytes); !done) {
    log::warning(kFleetPart, "how the maps lie is not kept for a restart: " + done.error().message);
    return;
  }
  written_ = std::move(bytes);
  pieces_.drop_all_but(robot_id_, packed_.pieces);
}

}  // namespace seeker::app
