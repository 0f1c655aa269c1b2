// What the main robot of a fleet does on its worker: files, and the judgement of maps.

#include <algorithm>
#include <cmath>
#include <future>
#include <utility>

#include "common/core/angle.hpp"
#include "common/log/log.hpp"
#include "common/wire/convert.hpp"
#include "common/wire/convert_fleet.hpp"
#include "common/wire/envelope.hpp"
#include "common/wire/sha256.hpp"
#include "seeker/v1/fleet.pb.h"
#include "server/app/fleet_leader.hpp"
#include "server/store/atomic_file.hpp"
#include "server/store/map_file.hpp"

namespace seeker::app {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPart = "fleet";
constexpr const char* kRecordFile = "record.pb";
constexpr const char* kPieceSuffix = ".piece";
/// Wall time for the loop to hand its map over.
constexpr std::chrono::seconds kOwnMapLimit{20};
/// A way to lay a map is the one that the operator accepted when it is this near to it.
constexpr double kSame_m = 1.0;
constexpr double kSame_rad = 0.2;

bool near(const Pose2& a, const Pose2& b) {
  return distance_m(a, b) < kSame_m && std::abs(wrap_angle(a.theta_rad - b.theta_rad)) < kSame_rad;
}

api::FleetState state_of(fleet::MergeVerdict verdict) {
  switch (verdict) {
    case fleet::MergeVerdict::kMerged: return api::FleetState::kMerged;
    case fleet::MergeVerdict::kAmbiguous: return api::FleetState::kAmbiguous;
    case fleet::MergeVerdict::kContradicted: return api::FleetState::kContradicted;
    case fleet::MergeVerdict::kInsufficientOverlap: return api::FleetState::kInsufficientOverlap;
  }
  return api::FleetState::kInsufficientOverlap;
}

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

Result<OwnMap> FleetLeader::ask_own_map() {
  auto promise = std::make_shared<std::promise<Result<OwnMap>>>();
  std::future<Result<OwnMap>> future = promise->get_future();
  own_map_([promise](Result<OwnMap> own) { promise->set_value(std::move(own)); });
  if (future.wait_for(kOwnMapLimit) != std::future_status::ready) {
    return fail(Errc::kTimeout, "the main robot's loop does not hand its map over");
  }
  return future.get();
}

void FleetLeader::judge(const std::string& robot_id) {
  api::FleetManifest manifest;
  Pieces pieces;
  bool whole = false;
  {
    const std::lock_guard lock(mutex_);
    Member& member = members_.at(robot_id);
    member.waits = false;
    whole = missing_of(member).empty();
    if (whole) {
      member.judged = std::chrono::steady_clock::now();
      manifest = member.manifest;
      pieces = member.pieces;
    }
  }
  if (!whole) {
    // It has announced more meanwhile, and is judged when that is here; until then what was found holds.
    join_all();
    return;
  }
  const Result<LineMap> map = unpack_map(manifest, pieces);
  settle(robot_id, map ? compare(robot_id, *map) : tl::unexpected<Error>(map.error()));
  join_all();
}

Result<fleet::MergeAnswer> FleetLeader::compare(const std::string& robot_id, const LineMap& map) {
  Result<OwnMap> own = ask_own_map();
  if (!own) {
    return fail_with_context("the main robot has no map yet", own.error());
  }
  {
    const std::lock_guard lock(mutex_);
    own_map_T_base_ = own->map_T_base;
    own_places_.clear();
    for (const MapNode& node : own->map.nodes) {
      own_places_.push_back(node.map_T_node.translation());
    }
  }
  if (Status ready = own_.update(std::move(own->map)); !ready) {
    return tl::unexpected<Error>(ready.error());
  }
  fleet::PreparedMap& other = prepared_[robot_id];
  if (Status ready = other.update(map); !ready) {
    return tl::unexpected<Error>(ready.error());
  }
  return merger_.merge(own_, other);
}

void FleetLeader::settle(const std::string& robot_id, const Result<fleet::MergeAnswer>& answer) {
  const std::lock_guard lock(mutex_);
  Member& member = members_.at(robot_id);
  const api::FleetState before = member.state;
  if (!answer) {
    member.state = api::FleetState::kWaiting;
    member.reason = answer.error().message;
    member.hypotheses.clear();
  } else {
    member.state = state_of(answer->verdict);
    member.reason = answer->reason;
    member.hypotheses = answer->hypotheses;
  }
  if (member.split) {
    member.state = api::FleetState::kSplit;
    member.reason = "taken out by the operator; 'seeker fleet merge' takes it in again";
  } else if (member.accepted && answer) {
    const auto same = std::find_if(member.hypotheses.begin(), member.hypotheses.end(),
                                   [&](const auto& one) { return near(one.a_T_b.a_T_b, *member.accepted); });
    const bool denied = same == member.hypotheses.end() || answer->verdict == fleet::MergeVerdict::kContradicted;
    if (denied) {
      member.state = api::FleetState::kContradicted;
      member.reason = "what was accepted does not fit what the robots have seen since: " + answer->reason;
      member.accepted.reset();
    } else {
      std::rotate(member.hypotheses.begin(), same, same + 1);
      member.state = api::FleetState::kMerged;
      member.reason = "accepted by the operator";
    }
  }
  if (member.state != before) {
    ++revision_;
    log::info(kPart, "robot '" + robot_id + "' is " + std::string(api::to_string(member.state)) + ": " + member.reason);
  }
}

void FleetLeader::join_all() {
  std::vector<fleet::RobotMap> maps{{0, &own_.map()}};
  std::vector<fleet::MapRelation> relations;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& [id, member] : members_) {
      if (member.state == api::FleetState::kMerged && !member.hypotheses.empty()) {
        maps.push_back({member.slot, &prepared_.at(id).map()});
        relations.push_back({0, member.slot, member.hypotheses.front().pairs});
      }
    }
  }
  joint_.reset();
  if (relations.empty()) {
    return;
  }
  Result<fleet::JointMap> joint = fleet::join(maps, relations, ++joint_epoch_);
  const std::lock_guard lock(mutex_);
  for (auto& [id, member] : members_) {
    if (member.state != api::FleetState::kMerged) {
      continue;
    }
    const auto placed = joint ? joint->robots.find(member.slot) : decltype(joint->robots.end()){};
    if (!joint || placed == joint->robots.end()) {
      member.state = api::FleetState::kAmbiguous;
      member.reason = joint ? "the other robots' maps outvote it" : joint.error().message;
      ++revision_;
    } else {
      member.main_T_map = placed->second.joint_T_map;
    }
  }
  if (joint) {
    joint_ = std::move(*joint);
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
