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

void ClientCommands::set_estop(bool engaged) {
  if (!parties_.motion.set_estop(engaged)) {
    return;
  }
  if (engaged) {
    parties_.executor.pause(parties_.world.now(), "emergency stop; release it and resume the mission");
  }
  parties_.motion.act({});  // no tick may come to tell why the robot stands now
}

Result<api::LeaseState> ClientCommands::command_lease(const std::string& client, api::LeaseAction action) {
  MotionAuthority& authority = parties_.motion.authority();
  const std::string before = authority.lease().owner;
  Result<api::LeaseState> state = authority.command_lease(client, action);
  if (state && state->owner != before) {
    parties_.diagnostics.log("lease",
                             state->owner.empty() ? "the lease is free" : "'" + state->owner + "' holds the lease");
  }
  const bool to_drive = action != api::LeaseAction::kRelease && parties_.motion.drivable();
  if (state && state->owner == client && to_drive) {
    authority.arm();
  }
  return state;
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

void ClientCommands::client_lost(const std::string& client, const std::string& why, WallTime wall_now) {
  parties_.diagnostics.log("link-lost", "'" + client + "': " + why, api::Severity::kWarning);
  parties_.motion.authority().forget(client);
  parties_.executor.client_lost(client, wall_now);
}

void ClientCommands::client_back(const std::string& client) { parties_.executor.client_back(client); }

void ClientCommands::client_closed(const std::string& client) { parties_.motion.authority().forget(client); }

}  // namespace seeker::app
