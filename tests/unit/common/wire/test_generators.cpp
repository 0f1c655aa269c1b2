#include "tests/unit/common/wire/generators.hpp"

namespace seeker::testing {

LaserScan ValueMaker::scan() {
  LaserScan s;
  s.stamp = time();
  s.sweep = flag() ? Duration(count(100'000'000) - 50'000'000) : Duration::zero();
  s.angle_min_rad = number();
  s.angle_step_rad = flag() ? 0.01 : -0.01;
  s.range_min_m = number();
  s.range_max_m = number();
  s.base_T_laser = pose();
  s.ranges_m.resize(static_cast<std::size_t>(count(30)));
  for (float& range : s.ranges_m) {
    range = flag() ? static_cast<float>(rng_.uniform() * 30.0) : kNoReturn;
  }
  s.quality.assign(flag() ? s.ranges_m.size() : 0, 9);
  return s;
}

SonarScan ValueMaker::sonar() {
  SonarScan s{time(), number(), number(), {}};
  for (int k = count(16); k > 0; --k) {
    s.readings.push_back({pose(), flag() ? 1.5F : kNoReturn});
  }
  return s;
}

OccupancyTile ValueMaker::tile() {
  OccupancyTile t;
  t.index = {count(100) - 50, count(100) - 50};
  t.revision = rng_.bits();
  const bool noisy = flag();
  for (auto& cell : t.cells) {
    cell = noisy ? static_cast<std::uint8_t>(rng_.below(256)) : kUnknownCell;
  }
  return t;
}

api::TileUpdate ValueMaker::tiles() {
  api::TileUpdate u{rng_.bits(), static_cast<std::uint32_t>(rng_.below(1000)), {}};
  for (int k = count(3); k > 0; --k) {
    u.tiles.push_back(tile());
  }
  return u;
}

api::Detection ValueMaker::detection() {
  api::Detection d;
  d.id = rng_.bits();
  d.target = text();
  d.stamp = time();
  d.u_px = number();
  d.v_px = number();
  d.score = rng_.uniform();
  d.map_T_base = pose();
  d.bearing_base_rad = number();
  d.bearing_map_rad = number();
  if (flag()) {
    d.position = point();
  }
  const double xy = number();
  d.position_covariance << number(), xy, xy, number();
  d.range_source = one_of(api::RangeSource::kFloor);
  d.sightings = count(50);
  d.map_epoch = static_cast<std::uint32_t>(count(9));
  d.mission = text();
  d.withdrawn = flag();
  return d;
}

api::CoverageSummary ValueMaker::coverage() { return {number(), number(), number(), number(), count(9)}; }

api::GridReport ValueMaker::grid() {
  api::GridReport g;
  g.lists = {rng_.uniform(), points(), points(), points(), count(9), count(9)};
  g.evidence.probability = Grid<std::uint8_t>({point(), 0.1 + rng_.uniform()}, count(20), count(20), 254);
  for (int k = count(3); k > 0; --k) {
    g.evidence.gaps.push_back({point(), number(), text()});
  }
  g.evidence.summary = coverage();
  g.evidence.map_epoch = static_cast<std::uint32_t>(count(9));
  g.map_epoch = static_cast<std::uint32_t>(count(9));
  return g;
}

ExploreDecision ValueMaker::decision() {
  ExploreDecision d;
  d.number = rng_.bits();
  d.stamp = time();
  d.rule = text();
  for (int k = count(4); k > 0; --k) {
    d.candidates.push_back({pose(), {number(), number()}, number(), number(), number(), number(), number(), text()});
  }
  if (!d.candidates.empty() && flag()) {
    d.chosen = static_cast<std::uint32_t>(rng_.below(d.candidates.size()));
  }
  d.why = text();
  return d;
}

PoseEstimate ValueMaker::estimate() {
  PoseEstimate e;
  e.stamp = time();
  e.map_T_base = pose();
  const Matrix3 any = Matrix3::NullaryExpr([this](auto) { return number(); });
  e.covariance = any + any.transpose().eval();
  e.quality = one_of(LocalisationQuality::kLost);
  e.cause = text();
  e.map_epoch = static_cast<std::uint32_t>(count(9));
  return e;
}

api::RobotStatus ValueMaker::status() {
  api::RobotStatus s;
  s.stamp = time();
  s.pose = estimate();
  s.odom_T_base = pose();
  s.velocity = {number(), number()};
  if (flag()) {
    s.battery_v = number();
  }
  s.estop = flag();
  s.motors_armed = flag();
  s.lease = lease();
  if (flag()) {
    s.mission = mission_status();
  }
  for (int k = count(3); k > 0; --k) {
    s.faults.push_back({text(), text(), one_of(api::Severity::kCritical), time(), text(), text()});
  }
  s.safety = text();
  s.clock_speed = number();
  s.map_revision = rng_.bits();
  if (flag()) {
    s.line_map = line_map();
  }
  if (flag()) {
    s.cut_off = api::CutOffMission{text(), text()};
    s.link_countdown = link_countdown();
  }
  if (flag()) {
    s.timing = TickTiming{rng_.bits(), rng_.bits(), Duration(rng_.below(1'000'000'000))};
  }
  return s;
}

MapSegment ValueMaker::segment() {
  MapSegment s;
  s.id = 1 + rng_.below(1'000'000);
  s.node = static_cast<std::uint32_t>(rng_.bits());
  s.map_T_segment = pose();
  s.length_m = rng_.uniform();
  s.left_real = flag();
  s.right_real = flag();
  const double cross = number();
  s.covariance << number(), cross, cross, number();
  s.hits = static_cast<std::uint32_t>(rng_.bits());
  s.created = time();
  s.last_seen = time();
  return s;
}

api::SegmentUpdate ValueMaker::segments() {
  api::SegmentUpdate update;
  update.revision = rng_.bits();
  update.map_epoch = static_cast<std::uint32_t>(rng_.bits());
  update.full = flag();
  for (int k = count(5); k > 0; --k) {
    update.changed.push_back(segment());
    update.removed.push_back(rng_.bits());
  }
  return update;
}

api::MapSummary ValueMaker::map_summary() {
  const auto figure = [this] { return static_cast<std::uint32_t>(rng_.bits()); };
  return {.name = "office",
          .robot_id = text(),
          .sensors = text(),
          .software_version = text(),
          .created_unix_s = count(1'000'000),
          .saved_unix_s = -count(1'000'000),
          .file_bytes = rng_.bits(),
          .epoch = figure(),
          .nodes = figure(),
          .edges = figure(),
          .loops = figure(),
          .segments = figure(),
          .keyframes = figure(),
          .problem = text()};
}

api::LandmarkSummary ValueMaker::landmark_summary() {
  return {.name = "lab",
          .robot_id = text(),
          .software_version = text(),
          .map_name = text(),
          .calibration = rng_.bits(),
          .created_unix_s = count(1'000'000),
          .saved_unix_s = -count(1'000'000),
          .file_bytes = rng_.bits(),
          .revision = rng_.bits(),
          .landmarks = static_cast<std::uint32_t>(rng_.bits()),
          .problem = text()};
}

api::LandmarkPoint ValueMaker::landmark() {
  return {rng_.bits() | 1U, {number(), number()}, number(), number(), static_cast<std::uint32_t>(rng_.bits())};
}

api::LineReport ValueMaker::lines() {
  api::LineReport report{
      .extractor = "five_modes", .scan = scan(), .lines = {}, .range_sigma_m = number(), .packets = {}};
  report.lines.resize(static_cast<std::size_t>(count(6)));
  for (api::ScanLine& line : report.lines) {
    line = {number(),
            number(),
            number(),
            number(),
            number(),
            std::nullopt,
            std::nullopt,
            {number(), number()},
            {number(), number()},
            count(300),
            number(),
            number(),
            number()};
    if (flag()) {
      line.slope = number();
      line.intercept_m = number();
    }
  }
  report.packets.resize(static_cast<std::size_t>(count(4)));
  for (api::LinePacket& packet : report.packets) {
    packet = {static_cast<std::uint32_t>(count(360)), static_cast<std::uint32_t>(count(360)), {}};
    packet.rounds.resize(static_cast<std::size_t>(count(9)), {number(), number(), number()});
  }
  return report;
}

api::LineMapStatus ValueMaker::line_map() {
  return {text(), one_of(api::MapUse::kLocalise), static_cast<std::uint32_t>(rng_.bits()), rng_.bits(), flag()};
}

std::vector<api::StampedPose> ValueMaker::trajectory() {
  std::vector<api::StampedPose> out(static_cast<std::size_t>(count(5)));
  for (api::StampedPose& one : out) {
    one = {time(), pose()};
  }
  return out;
}

api::RobotInfo ValueMaker::info() { return {"r2", text(), 1, 7, {"search", "goto"}, rng_.uniform(), flag()}; }

api::ComponentInfo ValueMaker::component() {
  api::ComponentInfo component{text(), text(), text(), one_of(api::ComponentState::kError), number(), text(), {}, {}};
  component.ports.resize(static_cast<std::size_t>(count(4)));
  for (api::ComponentPort& port : component.ports) {
    port = {text(), text(), flag(), {}, number(), std::nullopt};
    port.connected.assign(static_cast<std::size_t>(count(3)), "pose.scan");
    if (flag()) {
      port.age = Duration(count(1000));
    }
  }
  return component;
}

api::ComponentSetting ValueMaker::setting() { return {text(), text(), text(), one_of(api::SettingEffect::kRestart)}; }

api::Event ValueMaker::event() {
  api::Event e{rng_.bits(), time(), {}, text(), one_of(api::Severity::kCritical), text(), text()};
  if (flag()) {
    e.mission_time = Duration(count(1000));
  }
  return e;
}

RobotTopology ValueMaker::topology() {
  RobotTopology robot{"r1", pose(), std::nullopt, {}, std::nullopt, flag()};
  for (int k = count(4); k >= 0; --k) {
    const std::uint64_t id = ++robot.topology.current;
    // Sectors are in single precision on the wire.
    robot.topology.nodes.push_back({id, pose(), {{{0.25, 0.0}, -1.5, 3.0, 4.5}}, {}});
    robot.topology.nodes.back().goals = {{id, robot.topology.nodes.back().map_T_base * Point2(1.0, 2.0), 1 + count(5)}};
    robot.topology.edges.push_back({1, id});
  }
  return robot;
}

api::Payload ValueMaker::payload(api::Topic topic) {
  switch (topic) {
    case api::Topic::kStatus: return status();
    case api::Topic::kScan: return scan();
    case api::Topic::kSonar: return sonar();
    case api::Topic::kTiles: return tiles();
    case api::Topic::kGrid: return grid();
    case api::Topic::kImage: return frame();
    case api::Topic::kMission: return mission_status();
    case api::Topic::kSegments: return segments();
    case api::Topic::kEvent: return event();
    case api::Topic::kDetection: return detection();
    case api::Topic::kLines: return lines();
    case api::Topic::kTopology: return topology();
  }
  return status();
}

}  // namespace seeker::testing
