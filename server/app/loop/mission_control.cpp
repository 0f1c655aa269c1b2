#include "server/app/loop/mission_control.hpp"

#include <algorithm>
#include <utility>

namespace seeker::app {
namespace {

constexpr const char* kEstopLatched = "the emergency stop is latched; release it with 'seeker estop --release'";

/// All but looking into one direction from where it stands.
bool moves_robot(const api::MissionTask& task) {
  const auto* recognise = std::get_if<api::RecogniseMission>(&task);
  const auto* localise = std::get_if<api::LocaliseMission>(&task);
  return recognise != nullptr ? recognise->headings > 1 : localise == nullptr || localise->headings > 1;
}

bool needs_recogniser(const api::MissionTask& task) {
  return std::holds_alternative<api::SearchMission>(task) || std::holds_alternative<api::RecogniseMission>(task);
}

/// Where the newest scan was kept. There is one in every map that has been kept.
std::optional<Pose2> last_place(const LineMap& map) {
  const auto newest = std::max_element(map.keyframes.begin(), map.keyframes.end(),
                                       [](const MapKeyframe& a, const MapKeyframe& b) { return a.stamp < b.stamp; });
  for (const MapNode& node : map.nodes) {
    if (newest != map.keyframes.end() && node.id == newest->node) {
      return node.map_T_node * newest->node_T_base;
    }
  }
  return std::nullopt;
}

}  // namespace

MissionControl::MissionControl(const RobotMapParams& params, const Parties& parties)
    : parties_(parties),
      resumption_(params),
      checkpoints_(params, parties.localiser, parties.diagnostics, parties.hooks) {}

Status MissionControl::able_to(const api::MissionTask& task) const {
  if (const Status drivable = parties_.motion.drivable(); moves_robot(task) && !drivable) {
    return drivable;
  }
  if (needs_recogniser(task) && parties_.diagnostics.components().stopped("recogniser")) {
    return fail(
        Errc::kNotReady,
        "the recogniser is not active ('seeker components' says why); start it with 'seeker components --restart "
        "recogniser'");
  }
  return parties_.world.within_reach();
}

/// What is not kept on the disk is gone after a kill, and nobody would know that the mission ever was.
Status MissionControl::can_be_kept() const {
  const std::optional<api::Fault> fault = parties_.diagnostics.faults().find(kJournalFailed);
  return fault ? fail(Errc::kNotReady, "no mission can be kept on the disk: " + fault->message + "; " + fault->remedy)
               : Status();
}

Status MissionControl::may_start(const api::MissionRequest& request, const std::string& client) const {
  const MotionAuthority& authority = parties_.motion.authority();
  if (authority.estop()) {
    return fail(Errc::kRefused, kEstopLatched);
  }
  if (const Status free = authority.free_for(client); !free) {
    return free;
  }
  if (const Status able = able_to(request.task); !able) {
    return able;
  }
  if (const Status kept = can_be_kept(); !kept) {
    return kept;
  }
  const RobotMap& map = parties_.localiser.map();
  const PoseEstimate& pose = parties_.localiser.pose();
  const bool lost = map.has_segments() && pose.quality == LocalisationQuality::kLost;
  // Who looks for landmarks wants to know where a lost robot is.
  if (map.relocalising() || (lost && !std::holds_alternative<api::LocaliseMission>(request.task))) {
    return fail(Errc::kNotReady, "the robot does not know where it is in the map" +
                                     (pose.cause.empty() ? std::string() : " (" + pose.cause + ")") +
                                     "; 'seeker relocalise --wait' looks for it, --at X,Y,DEG helps");
  }
  return {};
}

Result<api::MissionId> MissionControl::start(const api::MissionRequest& request, const std::string& client) {
  if (runs(request.id)) {
    return request.id;  // asked for again by a client that has not got the answer
  }
  if (const Status free = may_start(request, client); !free) {
    return tl::unexpected<Error>(free.error());
  }
  const bool goes_on = resumption_.is_of(request.id);
  Result<api::MissionId> id = parties_.executor.start(request, client, parties_.situation.situation(),
                                                      goes_on ? resumption_.kept().so_far : MissionSoFar{});
  if (!id) {
    return id;
  }
  parties_.diagnostics.components().count_output("mission", "task", parties_.world.now());
  parties_.motion.authority().arm();
  if (!resumption_.has_own_map() || !goes_on) {
    drop_checkpoints();
  } else {
    parties_.executor.remember(resumption_.kept().memory);
  }
  resumption_.mission_began();
  checkpoints_.begin(parties_.world.now());
  return id;
}

Status MissionControl::command(api::MissionCommand command, const std::string& client) {
  const bool resume = command == api::MissionCommand::kResume;
  if (resume && parties_.motion.authority().estop()) {
    return fail(Errc::kRefused, kEstopLatched);
  }
  if (resume && resumption_.searching()) {
    return fail(Errc::kBusy, "the robot is looking for its place in the map it had; the mission goes on from there");
  }
  if (resume && !parties_.executor.present() && resumption_.unfinished()) {
    const Result<api::MissionId> again = start(api::MissionRequest(*resumption_.unfinished()), client);
    return again ? Status() : Status(tl::unexpected<Error>(again.error()));
  }
  const api::MissionRequest* paused = resume ? parties_.executor.request() : nullptr;
  if (const Status able = paused != nullptr ? able_to(paused->task) : parties_.world.within_reach(); resume && !able) {
    return able;
  }
  const Status done = parties_.executor.command(command, parties_.world.now());
  if (done && resume) {
    parties_.motion.authority().arm();
  }
  return done;
}

void MissionControl::end_unkept(const api::MissionId& mission, const Error& error) {
  if (runs(mission)) {
    const auto [cause, remedy] = cause_and_remedy(error);
    parties_.executor.end(api::Outcome::kFault, "the mission could not be kept on the disk: " + cause, remedy,
                          parties_.world.now());
    parties_.motion.authority().disarm();
    parties_.motion.act({});
  }
}

void MissionControl::stop() {
  resumption_.end_search();
  parties_.executor.end(api::Outcome::kOperator, "stopped by the operator", "", parties_.world.now());
}

void MissionControl::drop_checkpoints() {
  resumption_.forget_map();
  checkpoints_.drop(resumption_.needs_map());
}

std::optional<api::MissionId> MissionControl::checkpoint_to_resume() const {
  const bool wanted = resumption_.needs_map() && parties_.localiser.map().has_segments();
  return wanted && !parties_.executor.present() && !resumption_.searching() && !resumption_.has_own_map()
             ? std::optional(resumption_.unfinished()->id)
             : std::nullopt;
}

bool MissionControl::map_waits_for_resume() const {
  // A map that somebody has loaded meanwhile is meant to be used.
  return checkpoint_to_resume().has_value() && parties_.localiser.map().identity().name.empty();
}

Status MissionControl::resume_without_map(const Error& error, const KeptState& kept, const std::string& client) {
  if (error.code != Errc::kNotFound) {  // not found: cut off before there was one
    parties_.diagnostics.log("resume-without-map", error.message, api::Severity::kWarning);
  }
  resumption_.go_on_without_map(kept.so_far);
  return command(api::MissionCommand::kResume, client);
}

Status MissionControl::resume_in_map(const Result<LineMap>& map, const MapIdentity& identity, const std::string& client,
                                     KeptState kept) {
  if (parties_.motion.authority().estop()) {
    return fail(Errc::kRefused, kEstopLatched);
  }
  if (!resumption_.unfinished()) {
    return fail(Errc::kNotReady, "no mission was cut off");
  }
  if (Status able = able_to(resumption_.unfinished()->task); !able) {
    return able;
  }
  if (Status kept_on_disk = can_be_kept(); !kept_on_disk) {
    return kept_on_disk;
  }
  const Status usable = map ? validate(*map) : Status(tl::unexpected<Error>(map.error()));
  if (!usable) {
    return resume_without_map(usable.error(), kept, client);
  }
  if (parties_.executor.present()) {
    return parties_.maps.may_change();
  }
  // Also for a robot that still rolls: it brakes, and stands no farther off than it is looked for.
  if (Status ok = parties_.maps.replace(*map, identity); !ok) {
    return ok;
  }
  parties_.diagnostics.log("map-loaded", "the map of mission '" + resumption_.unfinished()->id +
                                             "' is loaded; the robot looks for its place in it");
  const RobotTime now = parties_.world.now();
  if (const auto place = kept.map_T_base ? kept.map_T_base : last_place(*map)) {
    if (Status ok = parties_.localiser.map().look_where_it_stood(*place, now); !ok) {
      return ok;
    }
  }
  resumption_.begin_search(std::move(kept), client, now);
  checkpoints_.adopt();
  parties_.motion.authority().arm();  // who resumes a mission wants the robot to move
  return {};
}

Twist2 MissionControl::search_velocity() {
  const bool in_other_hands = !parties_.motion.authority().free_for(resumption_.client());
  if (!resumption_.searching() || in_other_hands || parties_.sensing.odometry() == nullptr ||
      !parties_.localiser.map().relocalising()) {
    return {};
  }
  return resumption_.look_round(parties_.sensing.odom_T_base().theta_rad, parties_.world.now());
}

void MissionControl::resume_when_found() {
  const RobotMap& map = parties_.localiser.map();
  // What is known to be floor decides what is left to explore: the kept scans are written into it first.
  if (!resumption_.searching() || map.relocalising() || !map.settled()) {
    return;
  }
  resumption_.end_search();
  if (!is_placed(parties_.localiser.pose().quality)) {
    begin_new_map();
  }
  const auto& unfinished = resumption_.unfinished();
  const Result<api::MissionId> started = unfinished
                                             ? start(api::MissionRequest(*unfinished), resumption_.client())
                                             : Result<api::MissionId>(fail(Errc::kNotReady, "no mission was cut off"));
  if (!started) {
    parties_.diagnostics.log("resume-failed", started.error().message, api::Severity::kError);
  }
}

/// Better than a robot that is lost for good: the fleet, or an operator, may lay the two maps upon each other later.
void MissionControl::begin_new_map() {
  parties_.diagnostics.log(
      "resume-anew",
      "the robot did not find its place in the map it had (" + parties_.localiser.pose().cause +
          "): the mission begins a new one, and the old one is saved under a name; to go on in that one, stop the "
          "mission, load it with 'seeker map load NAME' and help with 'seeker relocalise --at X,Y,DEG'",
      api::Severity::kWarning);
  if (parties_.hooks.on_checkpoint_unused && resumption_.unfinished()) {
    parties_.hooks.on_checkpoint_unused(resumption_.unfinished()->id);
  }
  resumption_.go_on_without_map(resumption_.kept().so_far);
  parties_.maps.begin_new_map();
}

}  // namespace seeker::app
