// What the main robot keeps of each of the others on disk (FleetLeader).

#include <algorithm>
#include <utility>

#include "common/log/log.hpp"
#include "common/wire/convert.hpp"
#include "common/wire/convert_fleet.hpp"
#include "common/wire/envelope.hpp"
#include "common/wire/fleet_fields.hpp"
#include "common/wire/sha256.hpp"
#include "seeker/v1/fleet.pb.h"
#include "server/app/fleet/fleet_leader.hpp"
#include "server/app/fleet/fleet_settings.hpp"
#include "server/app/state/kept_message.hpp"
#include "server/store/atomic_file.hpp"

namespace seeker::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRecordFile = "record";
constexpr const char* kRecordKind = "fleet-robot";
constexpr const char* kPieceSuffix = ".piece";

std::string piece_name(const api::PieceHash& hash) { return wire::to_hex(hash) + kPieceSuffix; }

}  // namespace

void FleetLeader::tell_damage(const std::string& what) {
  log::warning(kFleetPart, what);
  host_.tell_operator("fleet-memory-damaged", what, api::Severity::kWarning);
}

std::vector<api::Detection> FleetLeader::load_found(const DetectionField& kept, const std::string& robot_id) {
  std::vector<api::Detection> found;
  wire::Check check;
  wire::read_detections(kept, found, check);
  if (!check.ok()) {
    tell_damage("what robot '" + robot_id + "' had found cannot be read again: " + check.status().error().message);
    return {};
  }
  return found;
}

Pieces FleetLeader::load_pieces(const fs::path& folder, const api::FleetManifest& manifest) const {
  Pieces pieces;
  for (const api::FleetNode& node : manifest.nodes) {
    Result<std::vector<std::uint8_t>> piece =
        store::read_file(folder / piece_name(node.hash), api::kMaxFleetPieceBytes);
    if (piece && wire::sha256_of(*piece) == node.hash) {
      pieces[node.hash] = std::make_shared<const std::vector<std::uint8_t>>(std::move(*piece));
    }
  }
  return pieces;
}

void FleetLeader::load_member(const fs::path& folder) {
  const auto record = read_kept_message<v1::FleetRecord>(folder / kRecordFile, kRecordKind, wire::kMaxFrameBytes);
  if (!record && record.error().code == Errc::kNotFound) {
    return;  // cut off before there was one
  }
  Result<api::FleetManifest> manifest = record ? wire::from_message<api::FleetManifest>(record->manifest())
                                               : Result<api::FleetManifest>(tl::unexpected<Error>(record.error()));
  if (!manifest || manifest->robot_id != folder.filename().string()) {
    tell_damage("what robot '" + folder.filename().string() +
                "' had sent cannot be read again, it has to send all of it: " +
                (manifest ? "the record is that of another robot" : manifest.error().message));
    return;
  }
  Member member;
  member.pieces = load_pieces(folder, *manifest);
  member.manifest = std::move(*manifest);
  member.split = record->split();
  if (member.split) {
    member.state = api::FleetState::kSplit;
    member.reason = kSplitReason;
  }
  if (record->has_accepted_main_t_map()) {
    if (const Result<Pose2> accepted = wire::from_message<Pose2>(record->accepted_main_t_map())) {
      member.accepted = *accepted;
    }
  }
  if (record->has_topology()) {
    if (Result<RobotTopology> topology = wire::from_message<RobotTopology>(record->topology())) {
      member.told.topology = std::move(*topology);
      member.told.topology->velocity.reset();
    }
  }
  member.told.finds = {load_found(record->detections(), member.manifest.robot_id),
                       load_found(record->earlier_detections(), member.manifest.robot_id)};
  const std::lock_guard lock(mutex_);
  const std::string id = member.manifest.robot_id;
  if (members_.size() + 1 < api::kMaxFleetRobots && !members_.contains(id)) {
    member.slot = free_slot(id);
    members_.emplace(id, std::move(member));
  }
}

void FleetLeader::keep_piece(const std::string& robot_id, const api::PieceHash& hash, const PieceBytes& bytes) const {
  const fs::path folder = params_.folder / robot_id;
  std::error_code error;
  fs::create_directories(folder, error);
  if (const Status kept = store::write_file_atomically(folder / piece_name(hash), *bytes); !kept) {
    log::warning(kFleetPart, "a piece of '" + robot_id + "' is not kept: " + kept.error().message);
  }
}

/// What no record speaks of any more may go.
void FleetLeader::drop_pieces(const std::string& robot_id, const Pieces& needed) const {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(params_.folder / robot_id, error)) {
    const bool wanted = std::any_of(needed.begin(), needed.end(), [&](const auto& piece) {
      return entry.path().filename() == piece_name(piece.first);
    });
    if (entry.path().extension() == kPieceSuffix && !wanted) {
      fs::remove(entry.path(), error);
    }
  }
}

void FleetLeader::keep_record(const std::string& robot_id) {
  const std::lock_guard writing(record_mutex_);
  v1::FleetRecord record;
  Pieces needed;
  {
    const std::lock_guard lock(mutex_);
    const Member& member = members_.at(robot_id);
    wire::write(member.manifest, record.mutable_manifest());
    record.set_split(member.split);
    if (member.accepted) {
      wire::write(*member.accepted, record.mutable_accepted_main_t_map());
    }
    if (member.told.topology) {
      wire::write(*member.told.topology, record.mutable_topology());
    }
    wire::write_detections(api::within_limits(member.told.finds.now), record.mutable_detections());
    wire::write_detections(api::within_limits(member.told.finds.before), record.mutable_earlier_detections());
    needed = member.pieces;
  }
  const fs::path file = params_.folder / robot_id / kRecordFile;
  if (const Status kept = store::write_sealed_file(file, kRecordKind, record.SerializeAsString()); !kept) {
    log::warning(kFleetPart, "what '" + robot_id + "' announced is not kept: " + kept.error().message);
    return;
  }
  drop_pieces(robot_id, needed);
}

}  // namespace seeker::app
