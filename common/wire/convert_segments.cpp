#include "common/wire/convert.hpp"

namespace seeker::wire {

void write(const MapSegment& from, pb::Segment* to) {
  to->set_id(from.id);
  to->set_node(from.node);
  write(from.map_T_segment, to->mutable_map_t_segment());
  to->set_length_m(from.length_m);
  to->set_left_real(from.left_real);
  to->set_right_real(from.right_real);
  to->set_yy_m2(from.covariance(0, 0));
  to->set_yt_m_rad(from.covariance(0, 1));
  to->set_tt_rad2(from.covariance(1, 1));
  to->set_hits(from.hits);
  to->set_created_ns(from.created.time_since_epoch().count());
  to->set_last_seen_ns(from.last_seen.time_since_epoch().count());
}

void read(const pb::Segment& from, MapSegment& to, Check& check) {
  to.id = from.id();
  if (to.id == 0) {
    check.refuse("id", Errc::kInvalidArgument, "must be above zero");
  }
  to.node = from.node();
  read_required(from.has_map_t_segment(), from.map_t_segment(), to.map_T_segment, "map_t_segment", check);
  to.length_m = check.finite("length_m", from.length_m());
  if (to.length_m < 0.0) {
    check.refuse("length_m", Errc::kInvalidArgument, "must not be negative");
  }
  to.left_real = from.left_real();
  to.right_real = from.right_real();
  const double cross = check.finite("yt_m_rad", from.yt_m_rad());
  to.covariance << check.finite("yy_m2", from.yy_m2()), cross, cross, check.finite("tt_rad2", from.tt_rad2());
  to.hits = from.hits();
  to.created = RobotTime(Duration(from.created_ns()));
  to.last_seen = RobotTime(Duration(from.last_seen_ns()));
}

void write(const api::SegmentUpdate& from, pb::SegmentUpdate* to) {
  to->set_revision(from.revision);
  to->set_map_epoch(from.map_epoch);
  to->set_full(from.full);
  for (const MapSegment& segment : from.changed) {
    write(segment, to->add_changed());
  }
  for (const std::uint64_t id : from.removed) {
    to->add_removed(id);
  }
}

void read(const pb::SegmentUpdate& from, api::SegmentUpdate& to, Check& check) {
  const auto changed = static_cast<std::size_t>(from.changed_size());
  const auto removed = static_cast<std::size_t>(from.removed_size());
  if (!check.count("changed", changed + removed, api::kMaxSegmentsPerUpdate)) {
    return;
  }
  to.revision = from.revision();
  to.map_epoch = from.map_epoch();
  to.full = from.full();
  to.changed.resize(changed);
  for (std::size_t k = 0; k < changed && check.ok(); ++k) {
    const auto scope = check.in("changed", k);
    read(from.changed(static_cast<int>(k)), to.changed[k], check);
  }
  to.removed.assign(from.removed().begin(), from.removed().end());
}

void write(const api::MapSummary& from, pb::MapSummary* to) {
  to->set_name(clean_text(from.name, kMaxMapNameBytes));
  to->set_robot_id(clean_text(from.robot_id, kMaxMapNameBytes));
  to->set_sensors(clean_text(from.sensors, kMaxMapNameBytes));
  to->set_software_version(clean_text(from.software_version, kMaxMapNameBytes));
  to->set_created_unix_s(from.created_unix_s);
  to->set_saved_unix_s(from.saved_unix_s);
  to->set_file_bytes(from.file_bytes);
  to->set_epoch(from.epoch);
  to->set_nodes(from.nodes);
  to->set_edges(from.edges);
  to->set_loops(from.loops);
  to->set_segments(from.segments);
  to->set_keyframes(from.keyframes);
  to->set_problem(clean_text(from.problem));
}

void read(const pb::MapSummary& from, api::MapSummary& to, Check& check) {
  to.name = check.text("name", from.name(), kMaxMapNameBytes);
  to.robot_id = check.text("robot_id", from.robot_id(), kMaxMapNameBytes);
  to.sensors = check.text("sensors", from.sensors(), kMaxMapNameBytes);
  to.software_version = check.text("software_version", from.software_version(), kMaxMapNameBytes);
  to.created_unix_s = from.created_unix_s();
  to.saved_unix_s = from.saved_unix_s();
  to.file_bytes = from.file_bytes();
  to.epoch = from.epoch();
  to.nodes = from.nodes();
  to.edges = from.edges();
  to.loops = from.loops();
  to.segments = from.segments();
  to.keyframes = from.keyframes();
  to.problem = check.text("problem", from.problem());
}

void write(const api::LineMapStatus& from, pb::LineMapStatus* to) {
  to->set_name(clean_text(from.name, kMaxMapNameBytes));
  to->set_use(static_cast<pb::MapUse>(wire_enum(from.use)));
  to->set_segments(from.segments);
  to->set_revision(from.revision);
  to->set_relocalising(from.relocalising);
}

void read(const pb::LineMapStatus& from, api::LineMapStatus& to, Check& check) {
  to.name = check.text("name", from.name(), kMaxMapNameBytes);
  check.enumerator("use", from.use(), api::MapUse::kLocalise, to.use);
  to.segments = from.segments();
  to.revision = from.revision();
  to.relocalising = from.relocalising();
}

}  // namespace seeker::wire
