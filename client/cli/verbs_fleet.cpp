// Several robots, one map: who has joined, how their maps lie, and the operator's word on it.

#include <cstdio>

#include <nlohmann/json.hpp>

#include "client/cli/export_check.hpp"
#include "client/cli/scene.hpp"
#include "client/cli/show_done.hpp"
#include "client/cli/tls_bundle.hpp"
#include "client/cli/verbs.hpp"
#include "client/values/values.hpp"
#include "client/values/values_json.hpp"
#include "common/core/angle.hpp"
#include "common/files/files.hpp"
#include "common/rpc/fleet_client.hpp"

namespace seeker::cli {
namespace {

std::string place_of(const Pose2& pose) {
  char text[96];
  std::snprintf(text, sizeof text, "(%.2f, %.2f) m, %.1f deg", pose.x_m, pose.y_m, rad_to_deg(pose.theta_rad));
  return text;
}

Json json_of(const api::FleetHypothesis& hypothesis) {
  Json json = hypothesis.main_T_map;
  json.update({{"confidence", hypothesis.confidence},
               {"shared_wall_m", hypothesis.shared_wall_m},
               {"contradiction", hypothesis.contradiction},
               {"pairs", hypothesis.pairs},
               {"pictures", hypothesis.pictures}});
  return json;
}

Json json_of(const api::FleetMember& member) {
  Json json = {
      {"robot_id", member.robot_id},     {"state", api::to_string(member.state)},   {"reason", member.reason},
      {"confidence", member.confidence}, {"by_operator", member.by_operator},       {"linked", member.linked},
      {"nodes", member.nodes},           {"pieces_missing", member.pieces_missing}, {"pictures", member.pictures}};
  if (member.main_T_map) {
    json.update(*member.main_T_map);
  }
  if (member.merged_with) {
    json["merged_with"] = {{"through", member.merged_with->through}, {"pictures", member.merged_with->pictures}};
  }
  Json& hypotheses = json["hypotheses"] = Json::array();
  for (const api::FleetHypothesis& hypothesis : member.hypotheses) {
    hypotheses.push_back(json_of(hypothesis));
  }
  json["detections"] = member.detections;
  return json;
}

void print(const Context& context, const api::FleetMember& member) {
  std::ostream& out = *context.out;
  out << member.robot_id << "  " << api::to_string(member.state) << (member.by_operator ? " (by the operator)" : "")
      << ", " << member.nodes << " local maps" << (member.linked ? "" : ", not linked now");
  if (member.main_T_map) {
    out << ", map at " << place_of(*member.main_T_map);
  }
  if (member.main_T_base) {
    out << ", robot at " << place_of(*member.main_T_base);
  }
  out << '\n';
  if (!member.reason.empty()) {
    out << "    " << member.reason;
    if (member.merged_with && member.merged_with->pictures > 0) {
      out << "; pictures of " << count_of(member.merged_with->pictures, "place") << " confirm it";
    }
    out << '\n';
  }
  for (std::size_t k = 0; k < member.hypotheses.size(); ++k) {
    const api::FleetHypothesis& hypothesis = member.hypotheses[k];
    char text[128];
    std::snprintf(text, sizeof text, ", confidence %.2f, %.1f m of wall shared, %u pairs, %u places by pictures",
                  hypothesis.confidence, hypothesis.shared_wall_m, hypothesis.pairs, hypothesis.pictures);
    out << "    hypothesis " << k << ": map at " << place_of(hypothesis.main_T_map) << text << '\n';
  }
  for (const api::Detection& detection : member.detections) {
    out << "    found: " << text_of(detection) << '\n';
  }
}

VerbResult show(const Context& context, const Result<api::FleetStatus>& fleet) {
  if (!fleet) {
    return tl::unexpected<Error>(fleet.error());
  }
  if (!context.json) {
    for (const api::FleetMember& member : fleet->members) {
      print(context, member);
    }
    return ExitCode::kOk;
  }
  Json members = Json::array();
  for (const api::FleetMember& member : fleet->members) {
    members.push_back(json_of(member));
  }
  *context.out << json_line({{"revision", fleet->revision}, {"members", members}}) << '\n';
  return ExitCode::kOk;
}

/// Calls the main robot of the fleet that the verb speaks of.
Result<rpc::FleetClient> fleet_of(const Context& context, const std::string& robot, const FleetOptions& options) {
  Result<rpc::Endpoint> at = rpc::parse_endpoint(options.main.empty() ? robot : options.main);
  if (!at) {
    return tl::unexpected<Error>(at.error());
  }
  // Where no port is written, parse_endpoint() gives that of a robot's server.
  const bool has_port = !options.main.empty() && at->port != rpc::kDefaultPort;
  at->port = has_port ? at->port : rpc::kDefaultFleetPort;
  Result<std::optional<pki::BundleFiles>> tls = bundle_for(context.tls, at->host);
  if (!tls) {
    return tl::unexpected<Error>(tls.error());
  }
  return rpc::FleetClient(std::move(*at), context.answer_time(), std::move(*tls));
}

VerbResult decide(const Context& context, const std::string& robot, const FleetOptions& options,
                  const api::FleetDecision& decision) {
  Result<rpc::FleetClient> client = fleet_of(context, robot, options);
  return show(context, client ? client->decide(decision) : tl::unexpected<Error>(client.error()));
}

Result<image::MapScene> picture_of(const api::FleetScene& fleet) {
  image::MapScene scene;
  scene.title = "Joint map";
  Result<std::optional<Grid<std::uint8_t>>> occupancy = join_tiles(fleet.floor);
  if (!occupancy) {
    return tl::unexpected<Error>(occupancy.error());
  }
  scene.occupancy = std::move(*occupancy);
  scene.topologies = fleet.robots;
  for (const RobotTopology& robot : fleet.robots) {
    const std::size_t nodes = robot.topology.nodes.size();
    scene.facts.emplace_back(robot.robot_id, nodes > 0 ? count_of(nodes, "node") : "no topology");
  }
  scene.facts.emplace_back("found", count_of(fleet.findings.size(), "target"));
  for (const api::FleetFinding& finding : fleet.findings) {
    scene.detections.push_back(mark_of(finding.detection));
  }
  return scene;
}

VerbResult draw_joint_map(const Context& context, rpc::FleetClient& client, const FleetMapVerb& verb) {
  if (const Status free = check_map_export(verb.file, verb.formats); !free) {
    return tl::unexpected<Error>(free.error());
  }
  const Result<api::FleetScene> fleet = client.scene();
  if (!fleet) {
    return tl::unexpected<Error>(fleet.error());
  }
  const Result<image::MapScene> scene = picture_of(*fleet);
  if (!scene) {
    return tl::unexpected<Error>(scene.error());
  }
  return show_files(context, export_scene(*scene, verb.file, verb.formats));
}

}  // namespace

Result<api::FleetStatus> fleet_status(const Context& context, const std::string& robot, const FleetOptions& options) {
  Result<rpc::FleetClient> client = fleet_of(context, robot, options);
  return client ? client->status() : tl::unexpected<Error>(client.error());
}

VerbResult fleet(const Context& context, const std::string& robot, const FleetStatusVerb& verb) {
  return show(context, fleet_status(context, robot, verb));
}

VerbResult fleet(const Context& context, const std::string& robot, const FleetMergeVerb& verb) {
  return decide(context, robot, verb, {verb.robot, api::FleetVerb::kMerge, verb.hypothesis});
}

VerbResult fleet(const Context& context, const std::string& robot, const FleetSplitVerb& verb) {
  return decide(context, robot, verb, {verb.robot, api::FleetVerb::kSplit, 0});
}

VerbResult fleet(const Context& context, const std::string& robot, const FleetMapVerb& verb) {
  Result<rpc::FleetClient> client = fleet_of(context, robot, verb);
  if (!client) {
    return tl::unexpected<Error>(client.error());
  }
  if (!verb.formats.empty()) {
    return draw_joint_map(context, *client, verb);
  }
  const auto bytes = client->map();
  if (!bytes) {
    return tl::unexpected<Error>(bytes.error());
  }
  return show_done(context, files::write_file(verb.file, *bytes), "wrote " + verb.file);
}

}  // namespace seeker::cli
