#include "client/values/values_json.hpp"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "client/values/values.hpp"

namespace seeker {

using cli::Json;
using cli::or_null;

void to_json(Json& json, const Pose2& pose) {
  json = {{"x_m", pose.x_m}, {"y_m", pose.y_m}, {"theta_rad", pose.theta_rad}};
}

void to_json(Json& json, const PoseEstimate& pose) {
  const bool placed = is_placed(pose.quality);
  const auto number = [&](double value) { return placed ? Json(value) : Json(); };
  json = {{"x_m", number(pose.map_T_base.x_m)},
          {"y_m", number(pose.map_T_base.y_m)},
          {"theta_rad", number(pose.map_T_base.theta_rad)},
          {"sigma_m", number(cli::sigma_m(pose.covariance.topLeftCorner<2, 2>()))},
          {"quality", to_string(pose.quality)},
          {"cause", pose.cause},
          {"map_epoch", pose.map_epoch}};
}

void to_json(Json& json, const DecisionCandidate& candidate) {
  json = {{"x_m", candidate.map_T_base.x_m},
          {"y_m", candidate.map_T_base.y_m},
          {"theta_rad", candidate.map_T_base.theta_rad},
          {"v_m_s", candidate.control.v_m_s},
          {"omega_rad_s", candidate.control.omega_rad_s},
          {"lg_j1", candidate.lg_j1},
          {"lg_j21", candidate.lg_j21},
          {"lg_j22", candidate.lg_j22},
          {"path_m", candidate.path_m},
          {"score", candidate.score},
          {"refused", candidate.refused}};
}

void to_json(Json& json, const ExploreDecision& decision) {
  json = {{"number", decision.number}, {"stamp_s", to_seconds(decision.stamp)}, {"rule", decision.rule},
          {"why", decision.why},       {"chosen", or_null(decision.chosen)},    {"candidates", decision.candidates}};
}

void to_json(Json& json, const MapSegment& segment) {
  json = {{"id", segment.id},
          {"left", segment.left()},
          {"right", segment.right()},
          {"length_m", segment.length_m},
          {"left_real", segment.left_real},
          {"right_real", segment.right_real},
          {"sigma_m", std::sqrt(std::max(0.0, segment.covariance(0, 0)))},
          {"sigma_rad", std::sqrt(std::max(0.0, segment.covariance(1, 1)))},
          {"hits", segment.hits}};
}

void to_json(Json& json, const UnreachablePlace& place) {
  json = {{"place", place.p_map},
          {"cause", to_string(place.cause)},
          {"size_m", place.size_m},
          {"text", place.text.empty() ? std::string(explain(place.cause)) : place.text},
          {"remedy", remedy_of(place.cause)}};
}

namespace {

Json json_of(const FreeSector& sector) {
  return {{"x_m", sector.from_base.x()},
          {"y_m", sector.from_base.y()},
          {"start_rad", sector.start_rad},
          {"span_rad", sector.span_rad},
          {"range_m", sector.radius_m}};
}

Json json_of(const TopologyNode& node) {
  Json sectors = Json::array();
  for (const FreeSector& sector : node.sectors) {
    sectors.push_back(json_of(sector));
  }
  Json goals = Json::array();
  for (const TopologyGoal& goal : node.goals) {
    goals.push_back({{"id", goal.id}, {"x_m", goal.p_map.x()}, {"y_m", goal.p_map.y()}, {"layer", goal.layer}});
  }
  return {{"id", node.id}, {"pose", node.map_T_base}, {"sectors", std::move(sectors)}, {"goals", std::move(goals)}};
}

}  // namespace

void to_json(Json& json, const RobotTopology& robot) {
  Json nodes = Json::array();
  for (const TopologyNode& node : robot.topology.nodes) {
    nodes.push_back(json_of(node));
  }
  Json edges = Json::array();
  for (const TopologyEdge& edge : robot.topology.edges) {
    edges.push_back({edge.a, edge.b});
  }
  json = {{"robot_id", robot.robot_id},        {"pose", robot.map_T_base},  {"active", robot.active},
          {"current", robot.topology.current}, {"nodes", std::move(nodes)}, {"edges", std::move(edges)}};
  json["target"] = robot.target_map ? Json{{"x_m", robot.target_map->x()}, {"y_m", robot.target_map->y()}} : Json();
}

namespace api {

void to_json(Json& json, const Detection& detection) {
  json = {{"id", detection.id},
          {"mission", detection.mission},
          {"target", detection.target},
          {"stamp_s", to_seconds(detection.stamp)},
          {"score", detection.score},
          {"bearing_base_rad", detection.bearing_base_rad},
          {"bearing_map_rad", detection.bearing_map_rad},
          {"seen_from", detection.map_T_base},
          {"position", or_null(detection.position)}};
  if (detection.position) {
    const Matrix2& c = detection.position_covariance;
    json["sigma_m"] = cli::sigma_m(c);
    json["covariance_m2"] = Json::array({c(0, 0), c(0, 1), c(1, 0), c(1, 1)});
  }
  json["range_source"] = to_string(detection.range_source);
  json["sightings"] = detection.sightings;
  json["withdrawn"] = detection.withdrawn;
}

void to_json(Json& json, const Gap& gap) {
  json = {{"centre", gap.centre}, {"area_m2", gap.area_m2}, {"reason", gap.reason}};
}

void to_json(Json& json, const CoverageSummary& coverage) {
  json = {{"reachable_area_m2", coverage.reachable_area_m2},
          {"covered_area_m2", coverage.covered_area_m2},
          {"threshold", coverage.threshold},
          {"mean_probability", coverage.mean_probability},
          {"gaps", coverage.gaps}};
}

void to_json(Json& json, const MissionEnd& end) {
  json = {{"outcome", to_string(end.outcome)},
          {"cause", end.cause},
          {"remedy", end.remedy},
          {"unreachable", positions_of(end.unreachable)},
          {"unreachable_places", end.unreachable}};
}

void to_json(Json& json, const MissionStatus& mission) {
  json = {{"id", mission.id},
          {"kind", mission.kind},
          {"state", to_string(mission.state)},
          {"phase", mission.phase},
          {"activity", mission.activity},
          {"progress", mission.progress},
          {"started_s", to_seconds(mission.started)},
          {"updated_s", to_seconds(mission.updated)},
          {"path_length_m", mission.path_length_m},
          {"cells_searched", mission.cells_searched},
          {"cells_unsearched", mission.cells_unsearched},
          {"link_policy", to_string(mission.link_policy)},
          {"link_steps", mission.link_steps},
          {"coverage", or_null(mission.coverage)},
          {"end", or_null(mission.end)},
          {"decision", or_null(mission.decision)}};
}

void to_json(Json& json, const Fault& fault) {
  json = {{"id", fault.id},
          {"component", fault.component},
          {"severity", to_string(fault.severity)},
          {"onset_s", to_seconds(fault.onset)},
          {"message", fault.message},
          {"remedy", fault.remedy}};
}

namespace {

Json line_map_of(const RobotStatus& status) {
  if (!status.line_map) {
    return {};
  }
  const auto& map = *status.line_map;
  return {{"name", map.name},
          {"use", to_string(map.use)},
          {"segments", map.segments},
          {"revision", map.revision},
          {"relocalising", map.relocalising}};
}

Json timing_of(const RobotStatus& status) {
  if (!status.timing) {
    return {};
  }
  return {
      {"ticks", status.timing->ticks}, {"late", status.timing->late}, {"worst_s", to_seconds(status.timing->worst)}};
}

Json cut_off_of(const RobotStatus& status) {
  return status.cut_off ? Json{{"id", status.cut_off->id}, {"kind", status.cut_off->kind}} : Json();
}

}  // namespace

void to_json(Json& json, const RobotStatus& status) {
  json = {{"stamp_s", to_seconds(status.stamp)},
          {"pose", status.pose},
          {"v_m_s", status.velocity.v_m_s},
          {"omega_rad_s", status.velocity.omega_rad_s},
          {"battery_v", or_null(status.battery_v)},
          {"estop", status.estop},
          {"motors_armed", status.motors_armed},
          {"lease_owner", status.lease.owner},
          {"lease", status.lease},
          {"safety", status.safety},
          {"clock_speed", status.clock_speed},
          {"map_revision", status.map_revision},
          {"line_map", line_map_of(status)},
          {"timing", timing_of(status)},
          {"mission", or_null(status.mission)},
          {"cut_off", cut_off_of(status)},
          {"link_countdown", or_null(status.link_countdown)},
          {"faults", status.faults}};
}

void to_json(Json& json, const ComponentPort& port) {
  json = {{"name", port.name},       {"type", port.type},
          {"output", port.output},   {"connected", port.connected},
          {"rate_hz", port.rate_hz}, {"age_s", port.age ? Json(to_seconds(*port.age)) : Json()}};
}

void to_json(Json& json, const ComponentLink& link) {
  json = {{"bytes_in", link.bytes_in},       {"bytes_out", link.bytes_out},         {"packets_in", link.packets_in},
          {"packets_bad", link.packets_bad}, {"bytes_skipped", link.bytes_skipped}, {"connects", link.connects}};
}

void to_json(Json& json, const ComponentInfo& component) {
  json = {{"name", component.name},       {"kind", component.kind},
          {"type", component.type},       {"state", to_string(component.state)},
          {"rate_hz", component.rate_hz}, {"last_error", component.last_error},
          {"ports", component.ports},     {"link", or_null(component.link)}};
}

void to_json(Json& json, const ComponentSetting& setting) {
  json = {
      {"key", setting.key}, {"value", setting.value}, {"path", setting.path}, {"effect", to_string(setting.effect)}};
}

void to_json(Json& json, const Event& event) {
  json = {{"sequence", event.sequence},
          {"stamp_s", to_seconds(event.stamp)},
          {"mission_time_s", event.mission_time ? Json(to_seconds(*event.mission_time)) : Json()},
          {"mission", event.mission},
          {"severity", to_string(event.severity)},
          {"kind", event.kind},
          {"text", event.text}};
}

void to_json(Json& json, const GridReport& grid) {
  json = {{"cell_size_m", grid.lists.cell_size_m},
          {"searched", grid.lists.searched},
          {"unsearched", grid.lists.unsearched},
          {"unreachable", grid.lists.unreachable},
          {"passes_n", grid.lists.passes_n},
          {"passes_limit_n", grid.lists.passes_limit_n},
          {"coverage", grid.evidence.summary},
          {"gaps", grid.evidence.gaps},
          {"map_epoch", grid.map_epoch}};
}

void to_json(Json& json, const MapSummary& map) {
  json = {{"name", map.name},
          {"robot_id", map.robot_id},
          {"sensors", map.sensors},
          {"software_version", map.software_version},
          {"created_unix_s", map.created_unix_s},
          {"saved_unix_s", map.saved_unix_s},
          {"file_bytes", map.file_bytes},
          {"epoch", map.epoch},
          {"nodes", map.nodes},
          {"edges", map.edges},
          {"loops", map.loops},
          {"segments", map.segments},
          {"keyframes", map.keyframes},
          {"problem", map.problem}};
}

void to_json(Json& json, const LandmarkSummary& database) {
  json = {{"name", database.name},
          {"robot_id", database.robot_id},
          {"software_version", database.software_version},
          {"map_name", database.map_name},
          {"calibration", database.calibration},
          {"created_unix_s", database.created_unix_s},
          {"saved_unix_s", database.saved_unix_s},
          {"file_bytes", database.file_bytes},
          {"revision", database.revision},
          {"landmarks", database.landmarks},
          {"problem", database.problem}};
}

void to_json(Json& json, const SegmentUpdate& update) {
  json = {{"revision", update.revision},
          {"map_epoch", update.map_epoch},
          {"full", update.full},
          {"changed", update.changed},
          {"removed", update.removed}};
}

void to_json(Json& json, const ScanLine& line) {
  json = {{"theta_rad", line.normal_rad},
          {"theta_start_rad", line.start_rad},
          {"theta_end_rad", line.end_rad},
          {"distance_m", line.distance_m},
          {"length_m", line.length_m},
          {"slope", or_null(line.slope)},
          {"intercept_m", or_null(line.intercept_m)},
          {"start", line.start},
          {"end", line.end},
          {"points", line.points},
          {"fit_error_m", line.fit_error_m},
          {"distance_sigma_m", line.distance_sigma_m},
          {"theta_sigma_rad", line.normal_sigma_rad}};
}

void to_json(Json& json, const LinePacket& packet) {
  Json rounds = Json::array();
  for (const LineRound& round : packet.rounds) {
    rounds.push_back({{"gap_m", round.gap_m}, {"corner_m", round.corner_m}, {"worst_error_m", round.worst_error_m}});
  }
  json = {{"first_beam", packet.first_beam}, {"last_beam", packet.last_beam}, {"rounds", std::move(rounds)}};
}

void to_json(Json& json, const LineReport& report) {
  // Without a signal quality of the scanner all usable beams have 1.
  const auto& quality = report.scan.quality;
  const bool has_quality = std::any_of(quality.begin(), quality.end(), [](std::uint8_t q) { return q > 1; });
  json = {{"extractor", report.extractor},
          {"scan_stamp_s", to_seconds(report.scan.stamp)},
          {"beams", report.scan.ranges_m.size()},
          {"has_quality", has_quality},
          {"range_sigma_m", report.range_sigma_m},
          {"lines", report.lines},
          {"packets", report.packets}};
}

namespace {

/// The payload of an update. Bulk data (pixels, cells) is summed up: `map export` and `camera grab` have it.
struct PayloadJson {
  Json operator()(const LaserScan& scan) const {
    return {{"beams", scan.ranges_m.size()},
            {"angle_min_rad", scan.angle_min_rad},
            {"angle_step_rad", scan.angle_step_rad},
            {"ranges_m", scan.ranges_m},
            {"quality", scan.quality}};
  }
  Json operator()(const SonarScan& sonar) const {
    Json ranges_m = Json::array();
    for (const SonarReading& reading : sonar.readings) {
      ranges_m.push_back(reading.range_m);
    }
    return {{"ranges_m", std::move(ranges_m)}};
  }
  Json operator()(const TileUpdate& tiles) const {
    return {{"revision", tiles.revision}, {"map_epoch", tiles.map_epoch}, {"tiles", tiles.tiles.size()}};
  }
  Json operator()(const ImageFrame& image) const {
    return {{"camera", image.camera},
            {"width_px", image.frame.image.width_px()},
            {"height_px", image.frame.image.height_px()}};
  }
  template <class T>
  Json operator()(const T& value) const {
    return Json(value);
  }
};

}  // namespace

void to_json(Json& json, const Update& update) {
  json = {{"topic", to_string(update.topic)},
          {"sequence", update.sequence},
          {"dropped", update.dropped},
          {"stamp_s", to_seconds(update.stamp)},
          {"data", std::visit(PayloadJson{}, update.payload)}};
}

}  // namespace api

std::string cli::json_line(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace seeker
