#include <algorithm>
#include <cmath>

#include "client/cli/values.hpp"
#include "common/core/angle.hpp"

namespace seeker::cli {

void write_json(Json& json, const Pose2& pose) {
  json.begin_object().field("x_m", pose.x_m).field("y_m", pose.y_m).field("theta_rad", pose.theta_rad).end_object();
}

void write_json(Json& json, const api::Detection& detection) {
  json.begin_object()
      .field("id", detection.id)
      .field("mission", detection.mission)
      .field("target", detection.target)
      .field("stamp_s", to_seconds(detection.stamp))
      .field("score", detection.score)
      .field("bearing_base_rad", detection.bearing_base_rad)
      .field("bearing_map_rad", detection.bearing_map_rad);
  json.key("seen_from");
  write_json(json, detection.map_T_base);
  json.key("position");
  if (detection.position) {
    json.value(*detection.position).field("sigma_m", sigma_m(detection.position_covariance));
    const Matrix2& c = detection.position_covariance;
    json.key("covariance_m2").begin_array().value(c(0, 0)).value(c(0, 1)).value(c(1, 0)).value(c(1, 1)).end_array();
  } else {
    json.null();
  }
  json.field("range_source", to_string(detection.range_source)).field("sightings", detection.sightings);
  json.field("withdrawn", detection.withdrawn).end_object();
}

void write_json(Json& json, const api::Gap& gap) {
  json.begin_object()
      .field("centre", gap.centre)
      .field("area_m2", gap.area_m2)
      .field("reason", gap.reason)
      .end_object();
}

void write_json(Json& json, const api::CoverageSummary& coverage) {
  json.begin_object()
      .field("reachable_area_m2", coverage.reachable_area_m2)
      .field("covered_area_m2", coverage.covered_area_m2)
      .field("threshold", coverage.threshold)
      .field("mean_probability", coverage.mean_probability)
      .field("gaps", coverage.gaps)
      .end_object();
}

void write_json(Json& json, const DecisionCandidate& candidate) {
  json.begin_object()
      .field("x_m", candidate.map_T_base.x_m)
      .field("y_m", candidate.map_T_base.y_m)
      .field("theta_rad", candidate.map_T_base.theta_rad)
      .field("v_m_s", candidate.control.v_m_s)
      .field("omega_rad_s", candidate.control.omega_rad_s)
      .field("lg_j1", candidate.lg_j1)
      .field("lg_j21", candidate.lg_j21)
      .field("lg_j22", candidate.lg_j22)
      .field("path_m", candidate.path_m)
      .field("score", candidate.score)
      .field("refused", candidate.refused)
      .end_object();
}

void write_json(Json& json, const ExploreDecision& decision) {
  json.begin_object()
      .field("number", decision.number)
      .field("stamp_s", to_seconds(decision.stamp))
      .field("rule", decision.rule)
      .field("why", decision.why)
      .key("chosen");
  decision.chosen ? json.value(*decision.chosen) : json.null();
  write_list(json, "candidates", decision.candidates);
  json.end_object();
}

void write_json(Json& json, const api::MissionStatus& mission) {
  json.begin_object()
      .field("id", mission.id)
      .field("kind", mission.kind)
      .field("state", to_string(mission.state))
      .field("phase", mission.phase)
      .field("activity", mission.activity)
      .field("progress", mission.progress)
      .field("started_s", to_seconds(mission.started))
      .field("updated_s", to_seconds(mission.updated))
      .field("path_length_m", mission.path_length_m)
      .field("cells_searched", mission.cells_searched)
      .field("cells_unsearched", mission.cells_unsearched)
      .field("link_policy", to_string(mission.link_policy));
  json.key("coverage");
  if (mission.coverage) {
    write_json(json, *mission.coverage);
  } else {
    json.null();
  }
  json.key("end");
  if (mission.end) {
    json.begin_object()
        .field("outcome", to_string(mission.end->outcome))
        .field("cause", mission.end->cause)
        .field("remedy", mission.end->remedy);
    write_list(json, "unreachable", mission.end->unreachable);
    json.end_object();
  } else {
    json.null();
  }
  json.key("decision");
  if (mission.decision) {
    write_json(json, *mission.decision);
  } else {
    json.null();
  }
  json.end_object();
}

namespace {

void write_fault(Json& json, const api::Fault& fault) {
  json.begin_object()
      .field("id", fault.id)
      .field("component", fault.component)
      .field("severity", to_string(fault.severity))
      .field("onset_s", to_seconds(fault.onset))
      .field("message", fault.message)
      .field("remedy", fault.remedy)
      .end_object();
}

void write_pose_estimate(Json& json, const PoseEstimate& pose) {
  json.begin_object();
  const bool placed = is_placed(pose.quality);
  const auto number = [&](std::string_view key, double value) {
    json.key(key);
    placed ? json.value(value) : json.null();
  };
  number("x_m", pose.map_T_base.x_m);
  number("y_m", pose.map_T_base.y_m);
  number("theta_rad", pose.map_T_base.theta_rad);
  number("sigma_m", sigma_m(pose.covariance.topLeftCorner<2, 2>()));
  json.field("quality", to_string(pose.quality))
      .field("cause", pose.cause)
      .field("map_epoch", pose.map_epoch)
      .end_object();
}

}  // namespace

void write_json(Json& json, const api::RobotStatus& status) {
  json.begin_object().field("stamp_s", to_seconds(status.stamp));
  json.key("pose");
  write_pose_estimate(json, status.pose);
  json.field("v_m_s", status.velocity.v_m_s).field("omega_rad_s", status.velocity.omega_rad_s);
  json.key("battery_v");
  status.battery_v ? json.value(*status.battery_v) : json.null();
  json.field("estop", status.estop).field("motors_armed", status.motors_armed).field("lease_owner", status.lease.owner);
  json.field("safety", status.safety)
      .field("clock_speed", status.clock_speed)
      .field("map_revision", status.map_revision);
  json.key("line_map");
  if (status.line_map) {
    json.begin_object()
        .field("name", status.line_map->name)
        .field("use", to_string(status.line_map->use))
        .field("segments", status.line_map->segments)
        .field("revision", status.line_map->revision)
        .field("relocalising", status.line_map->relocalising)
        .end_object();
  } else {
    json.null();
  }
  json.key("timing");
  if (status.timing) {
    json.begin_object()
        .field("ticks", status.timing->ticks)
        .field("late", status.timing->late)
        .field("worst_s", to_seconds(status.timing->worst))
        .end_object();
  } else {
    json.null();
  }
  json.key("mission");
  if (status.mission) {
    write_json(json, *status.mission);
  } else {
    json.null();
  }
  json.key("cut_off");
  if (status.cut_off) {
    json.begin_object().field("id", status.cut_off->id).field("kind", status.cut_off->kind).end_object();
  } else {
    json.null();
  }
  json.key("faults").begin_array();
  for (const api::Fault& fault : status.faults) {
    write_fault(json, fault);
  }
  json.end_array().end_object();
}

void write_json(Json& json, const api::ComponentInfo& component) {
  json.begin_object()
      .field("name", component.name)
      .field("kind", component.kind)
      .field("type", component.type)
      .field("state", to_string(component.state))
      .field("rate_hz", component.rate_hz)
      .field("last_error", component.last_error)
      .end_object();
}

void write_json(Json& json, const api::Event& event) {
  json.begin_object().field("sequence", event.sequence).field("stamp_s", to_seconds(event.stamp));
  json.key("mission_time_s");
  event.mission_time ? json.value(to_seconds(*event.mission_time)) : json.null();
  json.field("mission", event.mission)
      .field("severity", to_string(event.severity))
      .field("kind", event.kind)
      .field("text", event.text)
      .end_object();
}

void write_json(Json& json, const api::GridReport& grid) {
  json.begin_object().field("cell_size_m", grid.lists.cell_size_m);
  write_list(json, "searched", grid.lists.searched);
  write_list(json, "unsearched", grid.lists.unsearched);
  write_list(json, "unreachable", grid.lists.unreachable);
  json.field("passes_n", grid.lists.passes_n).field("passes_limit_n", grid.lists.passes_limit_n);
  json.key("coverage");
  write_json(json, grid.evidence.summary);
  write_list(json, "gaps", grid.evidence.gaps);
  json.field("map_epoch", grid.map_epoch).end_object();
}

void write_json(Json& json, const MapSegment& segment) {
  json.begin_object()
      .field("id", segment.id)
      .field("left", segment.left())
      .field("right", segment.right())
      .field("length_m", segment.length_m)
      .field("left_real", segment.left_real)
      .field("right_real", segment.right_real)
      .field("sigma_m", std::sqrt(std::max(0.0, segment.covariance(0, 0))))
      .field("sigma_rad", std::sqrt(std::max(0.0, segment.covariance(1, 1))))
      .field("hits", segment.hits)
      .end_object();
}

void write_json(Json& json, const api::SegmentUpdate& update) {
  json.begin_object()
      .field("revision", update.revision)
      .field("map_epoch", update.map_epoch)
      .field("full", update.full);
  write_list(json, "changed", update.changed);
  json.key("removed").begin_array();
  for (const std::uint64_t id : update.removed) {
    json.value(id);
  }
  json.end_array().end_object();
}

namespace {

/// The payload of an update. Bulk data (beams, pixels, cells) is summed up: `map export` and `camera grab` have it.
struct WriteData {
  Json& json;

  void operator()(const LaserScan& scan) const {
    json.begin_object()
        .field("beams", scan.ranges_m.size())
        .field("angle_min_rad", scan.angle_min_rad)
        .field("angle_step_rad", scan.angle_step_rad);
    json.key("ranges_m").begin_array();
    for (const float range_m : scan.ranges_m) {
      json.value(static_cast<double>(range_m));
    }
    json.end_array().end_object();
  }
  void operator()(const SonarScan& sonar) const {
    json.begin_object().key("ranges_m").begin_array();
    for (const SonarReading& reading : sonar.readings) {
      json.value(static_cast<double>(reading.range_m));
    }
    json.end_array().end_object();
  }
  void operator()(const api::TileUpdate& tiles) const {
    json.begin_object()
        .field("revision", tiles.revision)
        .field("map_epoch", tiles.map_epoch)
        .field("tiles", tiles.tiles.size())
        .end_object();
  }
  void operator()(const api::ImageFrame& image) const {
    json.begin_object()
        .field("camera", image.camera)
        .field("width_px", image.frame.image.width_px())
        .field("height_px", image.frame.image.height_px())
        .end_object();
  }
  template <class T>
  void operator()(const T& value) const {
    write_json(json, value);
  }
};

}  // namespace

void write_json(Json& json, const api::Update& update) {
  json.begin_object()
      .field("topic", to_string(update.topic))
      .field("sequence", update.sequence)
      .field("dropped", update.dropped)
      .field("stamp_s", to_seconds(update.stamp))
      .key("data");
  std::visit(WriteData{json}, update.payload);
  json.end_object();
}

}  // namespace seeker::cli
