#include "server/app/loop/client_commands.hpp"

namespace seeker::app {

Result<api::MissionId> ClientCommands::start_mission(const api::MissionRequest& request, const std::string& client) {
  return parties_.missions.start(request, client);
}

Status ClientCommands::command_mission(api::MissionCommand command, const std::string& client) {
  return parties_.missions.command(command, client);
}

void ClientCommands::stop() {
  parties_.missions.stop();
  parties_.motion.stop();
}

void ClientCommands::set_estop(bool engaged, const std::string& client) {
  if (!parties_.motion.set_estop(engaged, client)) {
    return;
  }
  if (engaged) {
    parties_.executor.pause(parties_.world.now(), "emergency stop; release it and resume the mission");
  }
  parties_.motion.act({});  // no tick may come to tell why the robot stands now
}

Result<api::LeaseState> ClientCommands::command_lease(const api::Caller& caller, const api::LeaseCommand& command,
                                                      WallTime wall_now) {
  MotionAuthority& authority = parties_.motion.authority();
  const api::LeaseState before = authority.lease();
  Result<api::LeaseState> state = authority.command_lease(caller, command, wall_now);
  note_lease(before, "'" + before.owner + "' has denied it");
  const bool to_drive = command.action != api::LeaseAction::kRelease && parties_.motion.drivable();
  if (state && state->owner == caller.client_name && to_drive) {
    authority.arm();
  }
  return state;
}

/// Tells in the log what has become of the lease; `why_not` is the reason why a request was not granted.
void ClientCommands::note_lease(const api::LeaseState& before, const std::string& why_not) {
  const api::LeaseState& now = parties_.motion.authority().lease();
  if (now.owner != before.owner) {
    parties_.diagnostics.log("lease", now.owner.empty() ? "the lease is free" : "'" + now.owner + "' holds the lease");
  } else if (now.stale && !before.stale) {
    parties_.diagnostics.log("lease-stale",
                             "'" + now.owner + "', who holds the lease, is not heard: others may have it",
                             api::Severity::kWarning);
  } else if (!now.requested_by.empty() && now.requested_by != before.requested_by) {
    parties_.diagnostics.log("lease-requested", "'" + now.requested_by + "' asks '" + now.owner + "' for the lease");
  } else if (now.requested_by.empty() && !before.requested_by.empty()) {
    parties_.diagnostics.log("lease-request-void", "'" + before.requested_by + "' does not get the lease: " + why_not);
  }
}

Status ClientCommands::drive(const std::string& client, const api::DriveCommand& command) {
  if (const Status drivable = parties_.motion.drivable(); !drivable) {
    return drivable;
  }
  if (const Status able = parties_.world.within_reach(); !able) {
    return able;
  }
  if (!parties_.world.realtime()) {
    return fail(Errc::kRefused,
                "the robot's clock runs at another speed than 1, so it cannot be driven by hand; start "
                "it with --set sim.speed=1");
  }
  if (parties_.executor.running()) {
    return fail(Errc::kBusy, "a mission is running; pause or stop it before driving by hand");
  }
  MotionAuthority& authority = parties_.motion.authority();
  const Status ok = authority.drive(client, command, parties_.world.now());
  if (ok) {
    authority.arm();
  }
  return ok;
}

Result<api::ImageFrame> ClientCommands::grab_image(const std::string& camera) {
  return parties_.perception.grab(camera);
}

Status ClientCommands::load_map(const LineMap& map, const MapIdentity& identity) {
  if (Status ok = parties_.maps.load(map, identity); !ok) {
    return ok;
  }
  parties_.missions.another_map_loaded();
  parties_.publisher.republish();
  return {};
}

Status ClientCommands::relocalise(const std::optional<Pose2>& map_T_base) {
  return parties_.maps.relocalise(map_T_base);
}

void ClientCommands::client_silent(const std::string& client, WallTime since) {
  const api::LeaseState before = parties_.motion.authority().lease();
  parties_.motion.authority().silent(client);
  note_lease(before, "it is not heard any more");
  parties_.executor.client_silent(client, since);
}

void ClientCommands::client_lost(const std::string& client, const std::string& why, WallTime wall_now) {
  parties_.diagnostics.log("link-lost", "'" + client + "': " + why, api::Severity::kWarning);
  client_silent(client, wall_now);
}

void ClientCommands::client_back(const std::string& client) {
  parties_.executor.client_back(client, parties_.world.now());
}

void ClientCommands::client_closed(const std::string& client) {
  const api::LeaseState before = parties_.motion.authority().lease();
  parties_.motion.authority().forget(client);
  note_lease(before, "it has left");
  parties_.executor.client_back(client, parties_.world.now());  // who leaves on purpose is not missed
}

void ClientCommands::watch(WallTime wall_now) {
  const api::LeaseState before = parties_.motion.authority().lease();
  if (parties_.motion.authority().watch(wall_now)) {
    note_lease(before, "'" + before.owner + "' did not answer in time");
  }
  if (parties_.executor.link_countdown()) {
    parties_.executor.watch_link(parties_.situation.situation(), wall_now);
  }
}

}  // namespace seeker::app
