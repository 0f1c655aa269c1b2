#include "server/app/fleet/fleet_part.hpp"

#include <utility>

#include "common/files/files.hpp"
#include "common/log/log.hpp"

namespace seeker::app {
namespace {

Status lead(const FleetSettings& settings, const std::filesystem::path& folder, const wire::AuditRows::Sink& decided,
            FleetPart& part) {
  part.server = std::make_unique<FleetServer>(*part.leader, settings.share_period, decided);
  const Result<std::uint16_t> port = part.server->start(settings.address, settings.port, settings.security);
  if (!port) {
    return fail_with_context("fleet", port.error());
  }
  log::info("fleet", "other robots join at " + settings.address + ":" + std::to_string(*port));
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  return files::write_file(folder / "port", std::to_string(*port) + "\n");
}

}  // namespace

Result<FleetPart> start_fleet(const FleetSettings& settings, const std::string& robot_id,
                              const std::string& software_version, const std::filesystem::path& folder,
                              const FleetHost& host) {
  FleetPart part;
  if (settings.lead && !settings.join.empty()) {
    return fail(Errc::kInvalidArgument, "a robot leads a fleet or joins one; set fleet.lead or fleet.join, not both");
  }
  if (settings.lead) {
    FleetLeaderParams params;
    params.folder = folder;
    params.robot_id = robot_id;
    params.software_version = software_version;
    params.silence_limit = settings.silence_limit;
    params.floor_period = settings.floor_period;
    params.search_age = settings.search_age;
    params.merge = settings.merge;
    part.leader = std::make_unique<FleetLeader>(std::move(params), host);
    if (const Status started = lead(settings, folder, host.decided, part); !started) {
      return tl::unexpected<Error>(started.error());
    }
  } else if (!settings.join.empty()) {
    Result<rpc::Endpoint> main = rpc::parse_endpoint(settings.join);
    if (!main) {
      return fail_with_context("fleet.join", main.error());
    }
    FleetFollowerParams params;
    params.main = std::move(*main);
    if (settings.security.tls()) {
      params.tls = settings.security.files;
    }
    params.robot_id = robot_id;
    params.period = settings.period;
    params.share_period = settings.share_period;
    params.floor_period = settings.floor_period;
    part.follower = std::make_unique<FleetFollower>(std::move(params), host);
  }
  return part;
}

}  // namespace seeker::app
