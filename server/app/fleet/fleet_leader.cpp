#include "server/app/fleet/fleet_leader.hpp"

#include <algorithm>
#include <utility>

#include "common/wire/sha256.hpp"

namespace seeker::app {
namespace {

constexpr std::size_t kMaxWaiting = 4096;                            ///< pieces to be written and maps to be judged
constexpr std::uint64_t kMaxRobotBytes = std::uint64_t{256} << 20U;  ///< of all pieces of one robot

const api::FleetNode* node_of(const api::FleetManifest& manifest, const api::PieceHash& hash) {
  const auto node = std::find_if(manifest.nodes.begin(), manifest.nodes.end(),
                                 [&](const api::FleetNode& one) { return one.hash == hash; });
  return node == manifest.nodes.end() ? nullptr : &*node;
}

api::FleetHypothesis describe(const fleet::MergeHypothesis& from) {
  return {from.a_T_b.a_T_b, from.confidence, from.shared_wall_m, from.contradiction,
          static_cast<std::uint32_t>(from.pairs.size())};
}

}  // namespace

std::vector<api::Detection> carried(std::vector<api::Detection> found, const Pose2& new_T_old) {
  for (api::Detection& one : found) {
    one = api::moved(std::move(one), new_T_old);
  }
  std::erase_if(found, [](const api::Detection& one) { return !api::in_reach(one); });
  return found;
}

FleetLeader::FleetLeader(FleetLeaderParams params, FleetHost host)
    : params_(std::move(params)), host_(std::move(host)), merger_(params_.merge), worker_(kMaxWaiting, "the fleet") {
  load();
}

Status FleetLeader::check_namesake(const api::FleetManifest& manifest, WallTime now) const {
  const auto taken = [&] {
    return fail(Errc::kRefused,
                "another robot of this fleet is called '" + manifest.robot_id + "'; give each its own robot_id");
  };
  if (manifest.robot_id == params_.robot_id) {
    return taken();
  }
  const auto known = members_.find(manifest.robot_id);
  if (known == members_.end()) {
    return members_.size() + 1 < api::kMaxFleetRobots ? Status()
                                                      : fail(Errc::kTooLarge, "a fleet has at most 16 robots");
  }
  const Member& member = known->second;
  return !silent(member.seen, now) && member.manifest.instance != manifest.instance ? taken() : Status();
}

Result<api::FleetAnswer> FleetLeader::announce(const api::FleetManifest& manifest) {
  std::uint64_t bytes = 0;
  for (const api::FleetNode& node : manifest.nodes) {
    bytes += node.piece_bytes;
  }
  if (bytes > kMaxRobotBytes) {
    return fail(Errc::kTooLarge, "the map has more than 256 MiB");
  }
  const std::lock_guard lock(mutex_);
  const WallTime now = std::chrono::steady_clock::now();
  if (const Status free = check_namesake(manifest, now); !free) {
    return tl::unexpected<Error>(free.error());
  }
  auto [known, is_new] = members_.try_emplace(manifest.robot_id);
  Member& member = known->second;
  if (is_new) {
    member.slot = free_slot(manifest.robot_id);
    ++revision_;
  }
  member.seen = now;
  const bool changed = is_new || member.manifest.nodes != manifest.nodes || member.manifest.edges != manifest.edges;
  if (!same_frame(member.manifest.nodes, manifest.nodes)) {
    begin_anew(member, manifest);
  }
  if (member.manifest.instance != manifest.instance) {
    member.told.finds = {{}, member.told.finds.all()};  // a program that was started anew has forgotten them
  }
  take(member, manifest);
  api::FleetAnswer answer{missing_of(member), {}};
  const bool old = !member.judged || now - *member.judged > params_.retry_period;
  if (answer.missing.empty() && !manifest.nodes.empty() && (changed || old)) {
    ask_for_judgement(manifest.robot_id, member);
  }
  answer.fleet = status_now();
  return answer;
}

/// All that was told are places in a map that is no more; those of the new one are told soon.
void FleetLeader::begin_anew(Member& member, const api::FleetManifest& manifest) {
  member.told = {};
  if (member.manifest.nodes.empty() || manifest.nodes.empty()) {
    return;  // its first map, or none yet
  }
  member.begun_anew = true;
  member.trouble.clear();
  member.main_T_map.reset();  // what is told in the new map must not be carried as if it were the old one
  member.hypotheses.clear();
  member.confidence = 0.0;
  ++revision_;
  if (!member.split) {
    member.state = api::FleetState::kWaiting;
    member.reason = "it has begun a new map, which has not been looked at yet";
  }
}

void FleetLeader::take(Member& member, const api::FleetManifest& manifest) {
  member.manifest = manifest;
  const auto forget = [&](auto& pieces) {
    std::erase_if(pieces, [&](const auto& piece) { return node_of(manifest, piece.first) == nullptr; });
  };
  forget(member.pieces);
  forget(member.partial);
}

std::vector<api::FleetMissing> FleetLeader::missing_of(const Member& member) {
  std::vector<api::FleetMissing> missing;
  for (const api::FleetNode& node : member.manifest.nodes) {
    if (!member.pieces.contains(node.hash)) {
      const auto begun = member.partial.find(node.hash);
      missing.push_back({node.hash, begun == member.partial.end() ? 0 : begun->second.size()});
    }
  }
  return missing;
}

Result<std::uint64_t> FleetLeader::receive(const api::FleetChunk& chunk) {
  const std::lock_guard lock(mutex_);
  const auto known = members_.find(chunk.robot_id);
  const api::FleetNode* node = known == members_.end() ? nullptr : node_of(known->second.manifest, chunk.hash);
  if (node == nullptr) {
    return fail(Errc::kNotFound, "nobody has announced this piece; announce the map again");
  }
  Member& member = known->second;
  if (member.pieces.contains(chunk.hash)) {
    return node->piece_bytes;
  }
  std::vector<std::uint8_t>& begun = member.partial[chunk.hash];
  if (chunk.offset != begun.size()) {
    return begun.size();  // sent twice, or a gap: the sender goes on from here
  }
  if (chunk.data.empty() || begun.size() + chunk.data.size() > node->piece_bytes) {
    member.partial.erase(chunk.hash);
    return fail(Errc::kTooLarge, "the piece is longer than it was announced, or nothing was sent");
  }
  begun.insert(begun.end(), chunk.data.begin(), chunk.data.end());
  if (begun.size() < node->piece_bytes) {
    return begun.size();
  }
  const auto bytes = std::make_shared<const std::vector<std::uint8_t>>(std::move(begun));
  member.partial.erase(chunk.hash);
  if (wire::sha256_of(*bytes) != chunk.hash) {
    return fail(Errc::kCorrupt, "the piece does not have the hash that was announced; it was thrown away");
  }
  member.pieces[chunk.hash] = bytes;
  // A full queue means that the disk cannot follow: the piece is sent again after a restart.
  static_cast<void>(
      worker_.post([this, id = chunk.robot_id, hash = chunk.hash, bytes] { keep_piece(id, hash, bytes); }));
  if (missing_of(member).empty()) {
    ask_for_judgement(chunk.robot_id, member);
  }
  return bytes->size();
}

void FleetLeader::ask_for_judgement(const std::string& robot_id, Member& member) {
  if (!member.waits) {
    member.waits = worker_
                       .post([this, robot_id] {
                         keep_record(robot_id);
                         judge(robot_id);
                       })
                       .has_value();
  }
}

api::FleetStatus FleetLeader::status() const {
  const std::lock_guard lock(mutex_);
  return status_now();
}

api::FleetStatus FleetLeader::status_now() const {
  api::FleetStatus status;
  status.revision = revision_;
  api::FleetMember own;
  own.robot_id = params_.robot_id;
  own.state = api::FleetState::kMerged;
  own.confidence = 1.0;
  own.linked = true;
  own.nodes = static_cast<std::uint32_t>(own_places_.size());
  own.main_T_map = Pose2{};
  own.main_T_base = own_map_T_base_;
  own.places = own_places_;
  own.detections = own_told_.finds.all();
  status.members.push_back(std::move(own));
  const WallTime now = std::chrono::steady_clock::now();
  for (const auto& [id, member] : members_) {
    status.members.push_back(describe(member, now));
  }
  return status;
}

api::FleetMember FleetLeader::describe(const Member& member, WallTime now) const {
  api::FleetMember out;
  out.robot_id = member.manifest.robot_id;
  out.state = member.state;
  out.reason = member.reason;
  out.by_operator = member.accepted.has_value();
  out.linked = member.seen && now - *member.seen < 2 * params_.silence_limit;
  out.nodes = static_cast<std::uint32_t>(member.manifest.nodes.size());
  out.pieces_missing = static_cast<std::uint32_t>(missing_of(member).size());
  for (const fleet::MergeHypothesis& hypothesis : member.hypotheses) {
    out.hypotheses.push_back(app::describe(hypothesis));
  }
  out.confidence = member.confidence;
  if (member.state == api::FleetState::kMerged) {
    out.main_T_map = member.main_T_map;
    if (member.main_T_map && member.manifest.map_T_base) {
      out.main_T_base = *member.main_T_map * *member.manifest.map_T_base;
    }
    if (member.main_T_map) {
      out.detections = carried(member.told.finds.all(), *member.main_T_map);
    }
  }
  for (const api::FleetNode& node : member.manifest.nodes) {
    out.places.push_back(node.node.map_T_node.translation());
  }
  return out;
}

Result<api::FleetStatus> FleetLeader::decide(const api::FleetDecision& decision) {
  Result<api::FleetStatus> decided = take_decision(decision);
  if (decided) {
    keep_record(decision.robot_id);  // at once: nobody says it a second time
  }
  return decided;
}

Result<api::FleetStatus> FleetLeader::take_decision(const api::FleetDecision& decision) {
  const std::lock_guard lock(mutex_);
  const auto known = members_.find(decision.robot_id);
  if (known == members_.end()) {
    return fail(Errc::kNotFound, "no robot '" + decision.robot_id + "' has joined; 'seeker fleet status' lists them");
  }
  Member& member = known->second;
  if (decision.verb == api::FleetVerb::kSplit) {
    member.split = true;
    member.accepted.reset();
  } else if (member.split && decision.hypothesis == 0 && member.hypotheses.empty()) {
    member.split = false;
  } else if (decision.hypothesis >= member.hypotheses.size()) {
    return fail(Errc::kRefused, "there is no such way to lay its map; 'seeker fleet status' lists them");
  } else {
    member.split = false;
    // Where the merger is certain by itself, nothing rests on the operator's word.
    const bool certain = decision.hypothesis == 0 && member.state == api::FleetState::kMerged;
    member.accepted = certain ? std::nullopt : std::optional<Pose2>(member.hypotheses[decision.hypothesis].a_T_b.a_T_b);
  }
  ask_for_judgement(decision.robot_id, member);
  ++revision_;
  member.state = member.split ? api::FleetState::kSplit : api::FleetState::kWaiting;
  member.reason = member.split ? kSplitReason : "its map is looked at once more";
  return status_now();
}

}  // namespace seeker::app
