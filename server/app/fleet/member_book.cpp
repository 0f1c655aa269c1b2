#include "server/app/fleet/member_book.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "common/log/log.hpp"
#include "server/app/fleet/fleet_settings.hpp"

namespace seeker::app {
namespace {

constexpr std::uint64_t kMaxRobotBytes = std::uint64_t{256} << 20U;  ///< of all pieces of one robot

tl::unexpected<Error> has_to_announce(const std::string& robot_id) {
  return fail(Errc::kNotFound, "robot '" + robot_id + "' has to announce its map first");
}

}  // namespace

MemberBook::MemberBook(const MemberBookParams& params, const OwnRobot& main, FleetErrands errands)
    : params_(params), main_(main), errands_(std::move(errands)) {}

void MemberBook::load(FleetSlots slots, std::vector<MemberRecord> records) {
  const std::lock_guard lock(mutex_);
  slots_ = std::move(slots);
  for (MemberRecord& record : records) {
    const std::string id = record.manifest.robot_id;
    if (members_.size() + 1 >= api::kMaxFleetRobots || members_.contains(id)) {
      continue;
    }
    const std::uint8_t slot = number_for(id);
    members_.emplace(id, Member(std::move(record), slot));
  }
}

void MemberBook::judge_complete() {
  const std::lock_guard lock(mutex_);
  for (auto& [id, member] : members_) {
    if (member.map.missing().empty()) {
      ask_for_judgement(id, member);
    }
  }
}

Status MemberBook::check_namesake(const api::FleetManifest& manifest, WallTime now) const {
  const auto taken = [&] {
    return fail(Errc::kRefused,
                "another robot of this fleet is called '" + manifest.robot_id + "'; give each its own robot_id");
  };
  if (manifest.robot_id == main_.id()) {
    return taken();
  }
  const auto known = members_.find(manifest.robot_id);
  if (known == members_.end()) {
    return members_.size() + 1 < api::kMaxFleetRobots ? Status()
                                                      : fail(Errc::kTooLarge, "a fleet has at most 16 robots");
  }
  const Member& member = known->second;
  return !silent(member.seen, now, params_.silence_limit) && member.map.manifest().instance != manifest.instance
             ? taken()
             : Status();
}

Member* MemberBook::find(const std::string& robot_id, std::uint64_t instance) {
  const auto known = members_.find(robot_id);
  const bool is_known = known != members_.end() && known->second.map.manifest().instance == instance;
  return is_known ? &known->second : nullptr;
}

std::uint8_t MemberBook::number_for(const std::string& robot_id) const {
  std::set<std::uint8_t> taken;
  for (const auto& [id, member] : members_) {
    if (id != robot_id) {
      taken.insert(member.slot);
    }
  }
  return slots_.number_for(robot_id, taken);
}

Result<api::FleetAnswer> MemberBook::announce(const api::FleetManifest& manifest, WallTime now) {
  std::uint64_t bytes = 0;
  for (const api::FleetNode& node : manifest.nodes) {
    bytes += node.piece_bytes;
  }
  for (const api::FleetPicture& picture : manifest.pictures) {
    bytes += picture.piece_bytes;
  }
  if (bytes > kMaxRobotBytes) {
    return fail(Errc::kTooLarge, "the map has more than 256 MiB");
  }
  const std::lock_guard lock(mutex_);
  if (const Status free = check_namesake(manifest, now); !free) {
    return tl::unexpected<Error>(free.error());
  }
  auto [known, is_new] = members_.try_emplace(manifest.robot_id);
  Member& member = known->second;
  if (is_new) {
    member.slot = number_for(manifest.robot_id);
    ++revision_;
  }
  member.seen = now;
  const api::FleetManifest& before = member.map.manifest();
  const bool changed = is_new || before.nodes != manifest.nodes || before.edges != manifest.edges ||
                       before.pictures != manifest.pictures;
  if (!same_frame(before.nodes, manifest.nodes) && member.begin_new_map(manifest)) {
    ++revision_;
  }
  if (before.instance != manifest.instance) {
    member.report.finds = {{}, member.report.finds.all()};  // a program that was restarted has forgotten them
  }
  member.map.announce(manifest);
  api::FleetAnswer answer{member.map.missing(), {}};
  const bool old = !member.judged || now - *member.judged > params_.retry_period;
  if (answer.missing.empty() && !manifest.nodes.empty() && (changed || old)) {
    ask_for_judgement(manifest.robot_id, member);
  }
  answer.fleet = status_now(now);
  return answer;
}

Result<std::uint64_t> MemberBook::receive(const api::FleetChunk& chunk) {
  const std::lock_guard lock(mutex_);
  const auto known = members_.find(chunk.robot_id);
  if (known == members_.end()) {
    return fail(Errc::kNotFound, kNotAnnounced);
  }
  Member& member = known->second;
  const Result<AnnouncedMap::Receipt> receipt = member.map.receive(chunk);
  if (!receipt) {
    return tl::unexpected<Error>(receipt.error());
  }
  if (receipt->completed) {
    errands_.keep_piece(chunk.robot_id, chunk.hash, receipt->completed);
    if (member.map.missing().empty()) {
      ask_for_judgement(chunk.robot_id, member);
    }
  }
  return receipt->bytes;
}

void MemberBook::ask_for_judgement(const std::string& robot_id, Member& member) {
  if (!member.judgement_waits) {
    member.judgement_waits = errands_.judge(robot_id);
  }
}

/// A full queue only delays it: the record is written with the next judgement, too.
void MemberBook::ask_for_record(const std::string& robot_id, Member& member) {
  if (!member.record_waits) {
    member.record_waits = errands_.keep_record(robot_id);
  }
}

Result<ReportingRobot> MemberBook::receive(const api::FleetShare& share, WallTime now) {
  const std::lock_guard lock(mutex_);
  Member* member = find(share.robot_id, share.instance);
  if (member == nullptr) {
    return has_to_announce(share.robot_id);
  }
  member->seen = now;
  member->shared = now;
  member->map.set_pose(share.topology ? std::optional(share.topology->map_T_base) : std::nullopt);
  member->report.receive_topology(share.topology);
  return received(share.robot_id, *member, now);
}

Result<ReportingRobot> MemberBook::receive(const api::FleetSeen& seen, WallTime now) {
  const std::lock_guard lock(mutex_);
  Member* member = find(seen.robot_id, seen.instance);
  if (member == nullptr) {
    return has_to_announce(seen.robot_id);
  }
  member->seen = now;
  if (seen.placed && member->report.receive_seen(seen.tiles, seen.sides, seen.detections, seen.searched, now)) {
    ask_for_record(seen.robot_id, *member);
  }
  return received(seen.robot_id, *member, now);
}

ReportingRobot MemberBook::received(const std::string& robot_id, const Member& member, WallTime now) const {
  ReportingRobot robot{member.standing.state(), member.standing.main_T_map(), member.map.manifest().map_T_base, {}};
  if (robot.main_T_map) {
    robot.others = others_than(robot_id, *robot.main_T_map, now);
  }
  return robot;
}

std::vector<OtherRobot> MemberBook::merged(WallTime now) const {
  const std::lock_guard lock(mutex_);
  return others_than(main_.id(), Pose2{}, now);
}

std::vector<OtherRobot> MemberBook::others_than(const std::string& robot_id, const Pose2& main_T_map,
                                                WallTime now) const {
  std::vector<OtherRobot> others;
  const Pose2 map_T_main = inverse(main_T_map);
  for (const auto& [id, member] : members_) {
    const std::optional<Pose2> main_T_theirs = member.standing.main_T_map();
    if (main_T_theirs && id != robot_id) {
      others.push_back(
          {id, member.report, map_T_main * *main_T_theirs, silent(member.shared, now, params_.silence_limit)});
    }
  }
  return others;
}

api::FleetStatus MemberBook::status(WallTime now) const {
  const std::lock_guard lock(mutex_);
  return status_now(now);
}

api::FleetStatus MemberBook::status_now(WallTime now) const {
  api::FleetStatus status;
  status.revision = revision_;
  status.members.reserve(members_.size() + 1);
  status.members.push_back(main_.describe());
  for (const auto& [id, member] : members_) {
    status.members.push_back(member.describe(now, params_.silence_limit));
  }
  return status;
}

Result<api::FleetStatus> MemberBook::decide(const api::FleetDecision& decision, WallTime now) {
  const std::lock_guard lock(mutex_);
  const auto known = members_.find(decision.robot_id);
  if (known == members_.end()) {
    return fail(Errc::kNotFound, "no robot '" + decision.robot_id + "' has joined; 'seeker fleet status' lists them");
  }
  Member& member = known->second;
  if (const Status decided = member.standing.decide(decision); !decided) {
    return tl::unexpected<Error>(decided.error());
  }
  ask_for_judgement(decision.robot_id, member);
  ++revision_;
  return status_now(now);
}

void MemberBook::begin_record(const std::string& robot_id) {
  const std::lock_guard lock(mutex_);
  members_.at(robot_id).record_waits = false;
}

MemberRecord MemberBook::record_of(const std::string& robot_id) const {
  const std::lock_guard lock(mutex_);
  return members_.at(robot_id).record();
}

std::map<std::string, std::uint8_t> MemberBook::slots() {
  const std::lock_guard lock(mutex_);
  for (const auto& [id, member] : members_) {
    slots_.keep(id, member.slot);
  }
  return slots_.kept();
}

std::vector<MemberMap> MemberBook::maps() const {
  const std::lock_guard lock(mutex_);
  std::vector<MemberMap> maps;
  maps.reserve(members_.size());
  for (const auto& [id, member] : members_) {
    maps.push_back({member.slot, member.map.manifest(), member.map.pieces()});
  }
  return maps;
}

std::optional<MemberMap> MemberBook::begin_judgement(const std::string& robot_id, WallTime now) {
  const std::lock_guard lock(mutex_);
  Member& member = members_.at(robot_id);
  member.judgement_waits = false;
  if (!member.map.missing().empty()) {
    return std::nullopt;
  }
  member.judged = now;
  member.standing.begin_judgement();
  return MemberMap{member.slot, member.map.manifest(), member.map.pieces()};
}

void MemberBook::set_trouble(const std::string& robot_id, std::string trouble) {
  const std::lock_guard lock(mutex_);
  members_.at(robot_id).standing.set_trouble(std::move(trouble));
}

std::vector<std::uint8_t> MemberBook::comparable_but(std::uint8_t slot) const {
  const std::lock_guard lock(mutex_);
  std::vector<std::uint8_t> slots;
  slots.reserve(members_.size());
  for (const auto& [id, member] : members_) {
    if (member.slot != slot && member.standing.comparable()) {
      slots.push_back(member.slot);
    }
  }
  return slots;
}

std::vector<fleet::PairAnswer> MemberBook::taking_part(std::vector<fleet::PairAnswer> pairs) {
  const std::lock_guard lock(mutex_);
  std::map<std::uint8_t, MemberStanding*> of_slot;
  for (auto& [id, member] : members_) {
    if (member.standing.takes_part()) {
      of_slot[member.slot] = &member.standing;
    }
  }
  std::erase_if(pairs, [&](const fleet::PairAnswer& pair) {
    return (pair.slot_a != kMainSlot && !of_slot.contains(pair.slot_a)) || !of_slot.contains(pair.slot_b);
  });
  for (fleet::PairAnswer& pair : pairs) {
    if (pair.slot_a == kMainSlot) {
      of_slot.at(pair.slot_b)->apply_acceptance(pair.answer);
    }
  }
  return pairs;
}

void MemberBook::settle(const JoinOutcome& outcome) {
  const std::lock_guard lock(mutex_);
  std::map<std::uint8_t, std::string> names;
  for (const auto& [id, member] : members_) {
    names[member.slot] = id;
  }
  for (auto& [id, member] : members_) {
    if (member.standing.settle(member.slot, outcome, names)) {
      ++revision_;
      report_state(member);
    }
  }
}

void MemberBook::report_state(const Member& member) const {
  const std::string& id = member.map.manifest().robot_id;
  const api::FleetState state = member.standing.state();
  const std::string text =
      "robot '" + id + "' is " + std::string(api::to_string(state)) + ": " + member.standing.reason();
  log::info(kFleetPart, text);
  if (state == api::FleetState::kAmbiguous) {
    errands_.notify_operator("fleet-ambiguous",
                             text + "; 'seeker fleet status' shows the ways to lay its map, 'seeker fleet merge " + id +
                                 " --hypothesis N' accepts one",
                             api::Severity::kWarning);
  } else if (state == api::FleetState::kContradicted) {
    errands_.notify_operator("fleet-contradicted", text, api::Severity::kWarning);
  }
}

}  // namespace seeker::app
