// Several robots, one map: who has joined, how their maps lie, and the operator's word on it.

#include <cstdio>

#include "client/cli/show_done.hpp"
#include "client/cli/values.hpp"
#include "client/cli/verbs.hpp"
#include "common/core/angle.hpp"
#include "common/image/files.hpp"
#include "common/rpc/fleet_client.hpp"

namespace seeker::cli {
namespace {

std::string place_of(const Pose2& pose) {
  char text[96];
  std::snprintf(text, sizeof text, "(%.2f, %.2f) m, %.1f deg", pose.x_m, pose.y_m, rad_to_deg(pose.theta_rad));
  return text;
}

void write_json(Json& json, const api::FleetHypothesis& hypothesis) {
  json.begin_object()
      .field("x_m", hypothesis.main_T_map.x_m)
      .field("y_m", hypothesis.main_T_map.y_m)
      .field("theta_rad", hypothesis.main_T_map.theta_rad)
      .field("confidence", hypothesis.confidence)
      .field("shared_wall_m", hypothesis.shared_wall_m)
      .field("contradiction", hypothesis.contradiction)
      .field("pairs", hypothesis.pairs)
      .end_object();
}

void write_json(Json& json, const api::FleetMember& member) {
  json.begin_object()
      .field("robot_id", member.robot_id)
      .field("state", api::to_string(member.state))
      .field("reason", member.reason)
      .field("confidence", member.confidence)
      .field("by_operator", member.by_operator)
      .field("linked", member.linked)
      .field("nodes", member.nodes)
      .field("pieces_missing", member.pieces_missing);
  if (member.main_T_map) {
    json.field("x_m", member.main_T_map->x_m)
        .field("y_m", member.main_T_map->y_m)
        .field("theta_rad", member.main_T_map->theta_rad);
  }
  json.key("hypotheses").begin_array();
  for (const api::FleetHypothesis& hypothesis : member.hypotheses) {
    write_json(json, hypothesis);
  }
  json.end_array().key("detections").begin_array();
  for (const api::Detection& detection : member.detections) {
    write_json(json, detection);
  }
  json.end_array().end_object();
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
    out << "    " << member.reason << '\n';
  }
  for (std::size_t k = 0; k < member.hypotheses.size(); ++k) {
    const api::FleetHypothesis& hypothesis = member.hypotheses[k];
    char text[128];
    std::snprintf(text, sizeof text, ", confidence %.2f, %.1f m of wall shared, %u pairs", hypothesis.confidence,
                  hypothesis.shared_wall_m, hypothesis.pairs);
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
  Json json;
  json.begin_object().field("revision", fleet->revision).key("members").begin_array();
  for (const api::FleetMember& member : fleet->members) {
    write_json(json, member);
  }
  *context.out << json.end_array().end_object().str() << '\n';
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
  return rpc::FleetClient(std::move(*at), context.answer_time());
}

VerbResult decide(const Context& context, const std::string& robot, const FleetOptions& options,
                  const api::FleetDecision& decision) {
  Result<rpc::FleetClient> client = fleet_of(context, robot, options);
  return show(context, client ? client->decide(decision) : tl::unexpected<Error>(client.error()));
}

}  // namespace

VerbResult fleet(const Context& context, const std::string& robot, const FleetStatusVerb& verb) {
  Result<rpc::FleetClient> client = fleet_of(context, robot, verb);
  return show(context, client ? client->status() : tl::unexpected<Error>(client.error()));
}

VerbResult fleet(const Context& context, const std::string& robot, const FleetMergeVerb& verb) {
  return decide(context, robot, verb, {verb.robot, api::FleetVerb::kMerge, verb.hypothesis});
}

VerbResult fleet(const Context& context, const std::string& robot, const FleetSplitVerb& verb) {
  return decide(context, robot, verb, {verb.robot, api::FleetVerb::kSplit, 0});
}

VerbResult fleet(const Context& context, const std::string& robot, const FleetMapVerb& verb) {
  Result<rpc::FleetClient> client = fleet_of(context, robot, verb);
  const auto bytes = client ? client->map() : tl::unexpected<Error>(client.error());
  if (!bytes) {
    return tl::unexpected<Error>(bytes.error());
  }
  return show_done(context, image::write_file(verb.file, *bytes), "wrote " + verb.file);
}

}  // namespace seeker::cli
