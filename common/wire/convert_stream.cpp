#include "common/wire/convert.hpp"
#include "common/wire/convert_fleet.hpp"

namespace seeker::wire {
namespace {

struct PayloadWriter {
  pb::StreamUpdate* to;

  void operator()(const api::RobotStatus& from) const { write(from, to->mutable_status()); }
  void operator()(const LaserScan& from) const { write(from, to->mutable_scan()); }
  void operator()(const SonarScan& from) const { write(from, to->mutable_sonar()); }
  void operator()(const api::TileUpdate& from) const { write(from, to->mutable_tiles()); }
  void operator()(const api::GridReport& from) const { write(from, to->mutable_grid()); }
  void operator()(const api::ImageFrame& from) const { write(from, to->mutable_image()); }
  void operator()(const api::MissionStatus& from) const { write(from, to->mutable_mission()); }
  void operator()(const api::Event& from) const { write(from, to->mutable_event()); }
  void operator()(const api::Detection& from) const { write(from, to->mutable_detection()); }
  void operator()(const api::SegmentUpdate& from) const { write(from, to->mutable_segments()); }
  void operator()(const api::LineReport& from) const { write(from, to->mutable_lines()); }
  void operator()(const RobotTopology& from) const { write(api::within_limits(from), to->mutable_topology()); }
};

template <class T, class M>
void read_payload(const M& from, api::Topic topic, std::string_view name, api::Update& to, Check& check) {
  if (to.topic != topic) {
    check.refuse("payload", Errc::kInvalidArgument, "does not belong to the topic");
    return;
  }
  const auto scope = check.in(name);
  read(from, to.payload.emplace<T>(), check);
}

}  // namespace

void write(const api::Update& from, pb::StreamUpdate* to) {
  to->set_topic(static_cast<pb::Topic>(wire_enum(from.topic)));
  to->set_sequence(from.sequence);
  to->set_stamp_ns(from.stamp.time_since_epoch().count());
  std::visit(PayloadWriter{to}, from.payload);
}

void read(const pb::StreamUpdate& from, api::Update& to, Check& check) {
  check.enumerator("topic", from.topic(), api::Topic::kTopology, to.topic);
  to.sequence = from.sequence();
  to.dropped = from.dropped();
  to.stamp = RobotTime(Duration(from.stamp_ns()));
  using P = pb::StreamUpdate;
  using T = api::Topic;
  switch (from.payload_case()) {
    case P::kStatus: return read_payload<api::RobotStatus>(from.status(), T::kStatus, "status", to, check);
    case P::kScan: return read_payload<LaserScan>(from.scan(), T::kScan, "scan", to, check);
    case P::kSonar: return read_payload<SonarScan>(from.sonar(), T::kSonar, "sonar", to, check);
    case P::kTiles: return read_payload<api::TileUpdate>(from.tiles(), T::kTiles, "tiles", to, check);
    case P::kGrid: return read_payload<api::GridReport>(from.grid(), T::kGrid, "grid", to, check);
    case P::kImage: return read_payload<api::ImageFrame>(from.image(), T::kImage, "image", to, check);
    case P::kMission: return read_payload<api::MissionStatus>(from.mission(), T::kMission, "mission", to, check);
    case P::kEvent: return read_payload<api::Event>(from.event(), T::kEvent, "event", to, check);
    case P::kDetection: return read_payload<api::Detection>(from.detection(), T::kDetection, "detection", to, check);
    case P::kSegments: return read_payload<api::SegmentUpdate>(from.segments(), T::kSegments, "segments", to, check);
    case P::kLines: return read_payload<api::LineReport>(from.lines(), T::kLines, "lines", to, check);
    case P::kTopology: return read_payload<RobotTopology>(from.topology(), T::kTopology, "topology", to, check);
    case P::PAYLOAD_NOT_SET: check.refuse("payload", Errc::kInvalidArgument, "is missing"); return;
  }
}

void write(const api::TopicRequest& from, pb::TopicRequest* to) {
  to->set_topic(static_cast<pb::Topic>(wire_enum(from.topic)));
  to->set_max_rate_hz(from.max_rate_hz);
  to->set_resume_after(from.resume_after);
}

void read(const pb::TopicRequest& from, api::TopicRequest& to, Check& check) {
  check.enumerator("topic", from.topic(), api::Topic::kTopology, to.topic);
  to.max_rate_hz = check.finite("max_rate_hz", from.max_rate_hz());
  if (to.max_rate_hz < 0.0 || to.max_rate_hz > kMaxStreamRate_hz) {
    check.refuse("max_rate_hz", Errc::kInvalidArgument, "must be from 0 to 1000");
  }
  to.resume_after = from.resume_after();
}

}  // namespace seeker::wire
