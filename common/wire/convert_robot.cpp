#include "common/wire/convert.hpp"

namespace seeker::wire {
namespace {

void write_covariance(const Matrix3& from, pb::Covariance3* to) {
  to->set_xx_m2(from(0, 0));
  to->set_xy_m2(from(0, 1));
  to->set_xt_m_rad(from(0, 2));
  to->set_yy_m2(from(1, 1));
  to->set_yt_m_rad(from(1, 2));
  to->set_tt_rad2(from(2, 2));
}

void read_covariance(const pb::Covariance3& from, Matrix3& to, Check& check) {
  const double xy = check.finite("xy_m2", from.xy_m2());
  const double xt = check.finite("xt_m_rad", from.xt_m_rad());
  const double yt = check.finite("yt_m_rad", from.yt_m_rad());
  to << check.finite("xx_m2", from.xx_m2()), xy, xt,  //
      xy, check.finite("yy_m2", from.yy_m2()), yt,    //
      xt, yt, check.finite("tt_rad2", from.tt_rad2());
}

void write_fault(const api::Fault& from, pb::Fault* to) {
  to->set_id(clean_text(from.id, kMaxNameBytes));
  to->set_component(clean_text(from.component, kMaxNameBytes));
  to->set_severity(static_cast<pb::Severity>(wire_enum(from.severity)));
  to->set_onset_ns(from.onset.time_since_epoch().count());
  to->set_message(clean_text(from.message));
  to->set_remedy(clean_text(from.remedy));
}

void read_fault(const pb::Fault& from, api::Fault& to, Check& check) {
  to.id = check.text("id", from.id(), kMaxNameBytes);
  to.component = check.text("component", from.component(), kMaxNameBytes);
  check.enumerator("severity", from.severity(), api::Severity::kCritical, to.severity);
  to.onset = RobotTime(Duration(from.onset_ns()));
  to.message = check.text("message", from.message());
  to.remedy = check.text("remedy", from.remedy());
}

}  // namespace

void write(const PoseEstimate& from, pb::PoseEstimate* to) {
  to->set_stamp_ns(from.stamp.time_since_epoch().count());
  write(from.map_T_base, to->mutable_map_t_base());
  write_covariance(from.covariance, to->mutable_covariance());
  to->set_quality(static_cast<pb::LocalisationQuality>(wire_enum(from.quality)));
  to->set_cause(clean_text(from.cause));
  to->set_map_epoch(from.map_epoch);
}

void read(const pb::PoseEstimate& from, PoseEstimate& to, Check& check) {
  to.stamp = RobotTime(Duration(from.stamp_ns()));
  read_required(from.has_map_t_base(), from.map_t_base(), to.map_T_base, "map_t_base", check);
  if (check.require("covariance", from.has_covariance())) {
    const auto scope = check.in("covariance");
    read_covariance(from.covariance(), to.covariance, check);
  }
  check.enumerator("quality", from.quality(), LocalisationQuality::kLost, to.quality);
  to.cause = check.text("cause", from.cause());
  to.map_epoch = from.map_epoch();
}

void write(const api::RobotInfo& from, pb::RobotInfo* to) {
  to->set_robot_id(clean_text(from.robot_id, kMaxNameBytes));
  to->set_software_version(clean_text(from.software_version, kMaxNameBytes));
  to->set_protocol_major(from.protocol_major);
  to->set_protocol_minor(from.protocol_minor);
  for (std::size_t k = 0; k < std::min(from.capabilities.size(), kMaxCapabilities); ++k) {
    to->add_capabilities(clean_text(from.capabilities[k], kMaxNameBytes));
  }
  to->set_robot_radius_m(from.robot_radius_m);
  to->set_realtime(from.realtime);
}

void read(const pb::RobotInfo& from, api::RobotInfo& to, Check& check) {
  to.robot_id = check.text("robot_id", from.robot_id(), kMaxNameBytes);
  to.software_version = check.text("software_version", from.software_version(), kMaxNameBytes);
  to.protocol_major = from.protocol_major();
  to.protocol_minor = from.protocol_minor();
  if (check.count("capabilities", static_cast<std::size_t>(from.capabilities_size()), kMaxCapabilities)) {
    for (const std::string& capability : from.capabilities()) {
      to.capabilities.push_back(check.text("capabilities", capability, kMaxNameBytes));
    }
  }
  to.robot_radius_m = check.finite("robot_radius_m", from.robot_radius_m());
  to.realtime = from.realtime();
}

void write(const api::LeaseState& from, pb::LeaseState* to) {
  to->set_owner(clean_text(from.owner, kMaxNameBytes));
  to->set_epoch(from.epoch);
  to->set_requested_by(clean_text(from.requested_by, kMaxNameBytes));
  to->set_stale(from.stale);
  to->set_sequence(from.sequence);
  to->set_request_left_ns(from.request_left.count());
}

void read(const pb::LeaseState& from, api::LeaseState& to, Check& check) {
  to.owner = check.text("owner", from.owner(), kMaxNameBytes);
  to.epoch = from.epoch();
  to.requested_by = check.text("requested_by", from.requested_by(), kMaxNameBytes);
  to.stale = from.stale();
  to.sequence = from.sequence();
  to.request_left = Duration(from.request_left_ns());
}

void write(const api::RobotStatus& from, pb::RobotStatus* to) {
  to->set_stamp_ns(from.stamp.time_since_epoch().count());
  write(from.pose, to->mutable_pose());
  write(from.odom_T_base, to->mutable_odom_t_base());
  write(from.velocity, to->mutable_velocity());
  if (from.battery_v) {
    to->set_battery_v(*from.battery_v);
  }
  to->set_estop(from.estop);
  to->set_motors_armed(from.motors_armed);
  write(from.lease, to->mutable_lease());
  if (from.mission) {
    write(*from.mission, to->mutable_mission());
  }
  for (std::size_t k = 0; k < std::min(from.faults.size(), kMaxFaults); ++k) {
    write_fault(from.faults[k], to->add_faults());
  }
  to->set_safety(clean_text(from.safety));
  to->set_clock_speed(from.clock_speed);
  to->set_map_revision(from.map_revision);
  if (from.line_map) {
    write(*from.line_map, to->mutable_line_map());
  }
  if (from.timing) {
    pb::TickTiming* timing = to->mutable_timing();
    timing->set_ticks(from.timing->ticks);
    timing->set_late(from.timing->late);
    timing->set_worst_ns(from.timing->worst.count());
  }
  if (from.cut_off) {
    to->mutable_cut_off()->set_id(clean_text(from.cut_off->id, kMaxNameBytes));
    to->mutable_cut_off()->set_kind(clean_text(from.cut_off->kind, kMaxNameBytes));
  }
  if (from.link_countdown) {
    write(*from.link_countdown, to->mutable_link_countdown());
  }
}

void read(const pb::RobotStatus& from, api::RobotStatus& to, Check& check) {
  to.stamp = RobotTime(Duration(from.stamp_ns()));
  read_required(from.has_pose(), from.pose(), to.pose, "pose", check);
  read_required(from.has_odom_t_base(), from.odom_t_base(), to.odom_T_base, "odom_t_base", check);
  read_required(from.has_velocity(), from.velocity(), to.velocity, "velocity", check);
  if (from.has_battery_v()) {
    to.battery_v = check.finite("battery_v", from.battery_v());
  }
  to.estop = from.estop();
  to.motors_armed = from.motors_armed();
  read_required(from.has_lease(), from.lease(), to.lease, "lease", check);
  if (from.has_mission()) {
    const auto scope = check.in("mission");
    read(from.mission(), to.mission.emplace(), check);
  }
  if (check.count("faults", static_cast<std::size_t>(from.faults_size()), kMaxFaults)) {
    to.faults.resize(static_cast<std::size_t>(from.faults_size()));
    for (std::size_t k = 0; k < to.faults.size(); ++k) {
      const auto scope = check.in("faults", k);
      read_fault(from.faults(static_cast<int>(k)), to.faults[k], check);
    }
  }
  to.safety = check.text("safety", from.safety());
  to.clock_speed = check.finite("clock_speed", from.clock_speed());
  to.map_revision = from.map_revision();
  if (from.has_line_map()) {
    const auto scope = check.in("line_map");
    read(from.line_map(), to.line_map.emplace(), check);
  }
  if (from.has_timing()) {
    to.timing = TickTiming{from.timing().ticks(), from.timing().late(), Duration(from.timing().worst_ns())};
  }
  if (from.has_cut_off()) {
    const auto scope = check.in("cut_off");
    to.cut_off.emplace();
    to.cut_off->id = check.text("id", from.cut_off().id(), kMaxNameBytes);
    to.cut_off->kind = check.text("kind", from.cut_off().kind(), kMaxNameBytes);
  }
  if (from.has_link_countdown()) {
    const auto scope = check.in("link_countdown");
    read(from.link_countdown(), to.link_countdown.emplace(), check);
  }
}

void write(const api::Event& from, pb::Event* to) {
  to->set_sequence(from.sequence);
  to->set_stamp_ns(from.stamp.time_since_epoch().count());
  if (from.mission_time) {
    to->set_mission_time_ns(from.mission_time->count());
  }
  to->set_mission(clean_text(from.mission, kMaxNameBytes));
  to->set_severity(static_cast<pb::Severity>(wire_enum(from.severity)));
  to->set_kind(clean_text(from.kind, kMaxNameBytes));
  to->set_text(clean_text(from.text));
}

void read(const pb::Event& from, api::Event& to, Check& check) {
  to.sequence = from.sequence();
  to.stamp = RobotTime(Duration(from.stamp_ns()));
  if (from.has_mission_time_ns()) {
    to.mission_time = Duration(from.mission_time_ns());
  }
  to.mission = check.text("mission", from.mission(), kMaxNameBytes);
  check.enumerator("severity", from.severity(), api::Severity::kCritical, to.severity);
  to.kind = check.text("kind", from.kind(), kMaxNameBytes);
  to.text = check.text("text", from.text());
}

void write(const api::DriveCommand& from, pb::DriveCommand* to) {
  write(from.velocity, to->mutable_velocity());
  to->set_ttl_ns(from.ttl.count());
  to->set_lease_epoch(from.lease_epoch);
  to->set_sequence(from.sequence);
  if (from.sent) {
    to->set_sent_ns(from.sent->time_since_epoch().count());
  }
}

void read(const pb::DriveCommand& from, api::DriveCommand& to, Check& check) {
  read_required(from.has_velocity(), from.velocity(), to.velocity, "velocity", check);
  to.ttl = Duration(from.ttl_ns());
  if (to.ttl <= Duration::zero() || to.ttl > api::kMaxDriveTtl) {
    check.refuse("ttl_ns", Errc::kInvalidArgument, "must be above zero and at most 1 s");
  }
  to.lease_epoch = from.lease_epoch();
  to.sequence = from.sequence();
  if (from.has_sent_ns()) {
    to.sent = RobotTime(Duration(from.sent_ns()));
  }
}

}  // namespace seeker::wire
