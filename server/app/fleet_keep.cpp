// What the main robot keeps of the others on disk (FleetLeader).

#include <algorithm>
#include <utility>

#include "common/log/log.hpp"
#include "common/wire/convert.hpp"
#include "common/wire/convert_fleet.hpp"
#include "common/wire/envelope.hpp"
#include "common/wire/sha256.hpp"
#include "seeker/v1/fleet.pb.h"
#include "server/app/fleet_leader.hpp"
#include "server/store/atomic_file.hpp"

namespace seeker::app {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPart = "fleet";
constexpr const char* kRecordFile = "record.pb";
constexpr const char* kPieceSuffix = ".piece";

}  // namespace

void FleetLeader::load() {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(params_.folder, error)) {
    if (entry.is_directory()) {
      load_member(entry.path());
    }
  }
}

void FleetLeader::load_member(const fs::path& folder) {
  const Result<std::vector<std::uint8_t>> bytes = store::read_file(folder / kRecordFile, wire::kMaxFrameBytes);
  v1::FleetRecord record;
  if (!bytes || !wire::parse_within_limits({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, record)) {
    return;
  }
  Result<api::FleetManifest> manifest = wire::from_message<api::FleetManifest>(record.manifest());
  if (!manifest || manifest->robot_id != folder.filename().string()) {
    log::warning(kPart, folder.string() + " holds no robot's map; it is left alone");
    return;
  }
  Member member;
  for (const api::FleetNode& node : manifest->nodes) {
    Result<std::vector<std::uint8_t>> piece =
        store::read_file(folder / (wire::to_hex(node.hash) + kPieceSuffix), api::kMaxFleetPieceBytes);
    if (piece && wire::sha256_of(*piece) == node.hash) {
      member.pieces[node.hash] = std::make_shared<const std::vector<std::uint8_t>>(std::move(*piece));
    }
  }
  member.manifest = std::move(*manifest);
  member.split = record.split();
  if (record.has_accepted_main_t_map()) {
    if (const Result<Pose2> accepted = wire::from_message<Pose2>(record.accepted_main_t_map())) {
      member.accepted = *accepted;
    }
  }
  if (record.has_topology()) {
    if (Result<RobotTopology> topology = wire::from_message<RobotTopology>(record.topology())) {
      member.topology = std::move(*topology);
      member.topology->velocity.reset();
    }
  }
  const std::lock_guard lock(mutex_);
  const std::string id = member.manifest.robot_id;
  if (members_.size() + 1 >= api::kMaxFleetRobots || members_.contains(id)) {
    return;
  }
  member.slot = static_cast<std::uint8_t>(members_.size() + 1);
  Member& kept = members_.emplace(id, std::move(member)).first->second;
  if (missing_of(kept).empty()) {
    ask_for_judgement(id, kept);
  }
}

void FleetLeader::keep_piece(const std::string& robot_id, const api::PieceHash& hash, const PieceBytes& bytes) const {
  const fs::path folder = params_.folder / robot_id;
  std::error_code error;
  fs::create_directories(folder, error);
  if (const Status kept = store::write_file_atomically(folder / (wire::to_hex(hash) + kPieceSuffix), *bytes); !kept) {
    log::warning(kPart, "a piece of '" + robot_id + "' is not kept: " + kept.error().message);
  }
}

void FleetLeader::keep_record(const std::string& robot_id) {
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
    if (member.topology) {
      wire::write(*member.topology, record.mutable_topology());
    }
    needed = member.pieces;
  }
  const fs::path folder = params_.folder / robot_id;
  std::error_code error;
  fs::create_directories(folder, error);
  if (const Status kept = store::write_file_atomically(folder / kRecordFile, record.SerializeAsString()); !kept) {
    log::warning(kPart, "what '" + robot_id + "' announced is not kept: " + kept.error().message);
    return;
  }
  // What no record speaks of any more may go.
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const bool wanted = std::any_of(needed.begin(), needed.end(), [&](const auto& piece) {
      return entry.path().filename() == wire::to_hex(piece.first) + kPieceSuffix;
    });
    if (entry.path().extension() == kPieceSuffix && !wanted) {
      fs::remove(entry.path(), error);
    }
  }
}

}  // namespace seeker::app
