#include "server/app/loop/robot_loop.hpp"

#include <utility>

#include "server/app/loop/capabilities.hpp"
#include "server/app/loop/robot_components.hpp"

namespace seeker::app {
namespace {

/// Wall time from one call to the next.
class Laps {
 public:
  explicit Laps(WallTime start) : last_(start) {}
  [[nodiscard]] Duration lap() {
    const WallTime now = std::chrono::steady_clock::now();
    return now - std::exchange(last_, now);
  }

 private:
  WallTime last_;
};

}  // namespace

RobotLoop::RobotLoop(const LoopParams& params, LoopParts parts, UpdateHub& hub)
    : devices_(parts.devices),
      diagnostics_(devices_.clock, hub, hooks_),
      world_(devices_.clock, devices_.type, params.period, params.mission.fault_grace, diagnostics_),
      sensing_(params, devices_, world_, diagnostics_),
      neighbours_(params.fleet, params.robot_id),
      localiser_(params, parts.occupancy, std::move(parts.estimator), diagnostics_),
      situation_(world_, sensing_, localiser_, neighbours_, devices_.stereo != nullptr && parts.stereo != nullptr),
      motion_(params.safety, params.odometry_calibration, devices_.base, sensing_, situation_, world_, diagnostics_),
      executor_(params.mission, parts.behaviours, mission_outputs(hub)),
      perception_({devices_, parts.stereo, parts.pictures, world_, diagnostics_, hub}, params.pictures, sensing_,
                  localiser_, executor_),
      maps_({world_, sensing_, motion_, localiser_, neighbours_, executor_, diagnostics_}, parts.forget_places),
      missions_(params.map,
                {executor_, world_, sensing_, situation_, localiser_, maps_, motion_, diagnostics_, hooks_}),
      publisher_(params, parts.lines,
                 {world_, sensing_, localiser_, neighbours_, motion_, executor_, missions_.resumption(), diagnostics_},
                 hub),
      components_(
          {world_, sensing_, neighbours_, localiser_, motion_, executor_, missions_, maps_, publisher_, diagnostics_},
          devices_, parts.configuration),
      commands_({world_, perception_, motion_, executor_, missions_, maps_, components_, publisher_, diagnostics_,
                 situation_}) {
  add_components(diagnostics_.components(), parts, devices_, params.connections);
}

RobotLoop::~RobotLoop() { shut_down(); }

MissionOutputs RobotLoop::mission_outputs(UpdateHub& hub) {
  return {.event = [this](const api::Event& event) { diagnostics_.emit(event); },
          .status =
              [this, &hub](const api::MissionStatus& status) {
                if (hooks_.on_mission) {
                  hooks_.on_mission(status);
                }
                if (status.end) {
                  missions_.drop_checkpoints();
                }
                hub.publish(api::Topic::kMission, now(), status);
              },
          .detection =
              [this, &hub](const api::Detection& detection) {
                if (hooks_.on_detection) {
                  hooks_.on_detection(detection);
                }
                hub.publish(api::Topic::kDetection, now(), detection);
              },
          .begun =
              [this](const api::MissionRequest& request) {
                if (hooks_.on_mission_started) {
                  hooks_.on_mission_started(request);
                }
              }};
}

void RobotLoop::start() {
  components_.start();
  sense();
  estimate();
  localiser_.note_pose(now());
}

void RobotLoop::shut_down() {
  motion_.halt();
  diagnostics_.components().deactivate_all();
  world_.let_go();
}

bool RobotLoop::idle() const {
  if (world_.ended()) {
    return true;
  }
  // A robot that looks for its place needs scans; a map that is written anew is to be finished.
  const RobotMap& map = localiser_.map();
  const bool settled = map.settled() && !map.relocalising() && !missions_.resumption().searching();
  return !world_.realtime() && !devices_.runs_without_mission && !executor_.running() && !sensing_.moving() && settled;
}

void RobotLoop::tick(WallTime wall_now) {
  TickTimes times{.begun = wall_now};
  Laps laps(wall_now);
  sense();
  times.sense = laps.lap();
  estimate();
  times.estimate = laps.lap();
  motion_.act(decide(wall_now));
  times.decide = laps.lap();
  publish();
  times.publish = laps.lap();
  if (hooks_.on_tick) {
    hooks_.on_tick(times);
  }
  if (const Status advanced = world_.advance(); !advanced) {
    end_source(advanced.error());
  }
}

void RobotLoop::sense() {
  sensing_.read();
  motion_.look_around();
  // A recording cannot be slowed, and is to give the map that it gives offline.
  const LaserScan* scan = sensing_.new_scan();
  if (hooks_.on_odometry && sensing_.new_measured_odometry() != nullptr) {
    hooks_.on_odometry(*sensing_.new_measured_odometry());
  }
  if (hooks_.on_scan && scan != nullptr) {
    hooks_.on_scan(*scan);
  }
  if (scan != nullptr && sensing_.odometry() != nullptr && !devices_.runs_without_mission) {
    neighbours_.observe(*scan, sensing_.history().at(scan->stamp)->odom_T_base, now());
  }
}

void RobotLoop::estimate() {
  if (const std::optional<MapShift> shift = localiser_.localise(sensing_, neighbours_, now())) {
    executor_.map_moved(shift->correction, now());
    if (shift->new_T_old) {
      neighbours_.map_moved(*shift->new_T_old);
    }
  }
  localiser_.map_readings(sensing_);
}

Twist2 RobotLoop::decide(WallTime wall_now) {
  missions_.resume_when_found();
  perception_.take_answers();
  const Decision decision = executor_.step(situation_.situation(), diagnostics_.faults().blocking(), wall_now);
  neighbours_.note_own(executor_.behaviour(), localiser_.pose().map_T_base, sensing_.velocity());
  perception_.look_for_fleet(neighbours_, now());
  if (decision.wants_image && executor_.running()) {
    perception_.look_for_targets();
  }
  if (decision.place) {
    localiser_.place_at(*decision.place, now());
  }
  const bool for_mission = decision.wants_look && executor_.running();
  if (for_mission || localiser_.wants_look(now())) {
    perception_.look_with_both(for_mission);
  }
  if (executor_.running()) {
    diagnostics_.components().count_output("planner", "velocity", now());
    motion_.authority().cancel_drive();
    return decision.command;
  }
  const std::optional<Twist2> driven = motion_.authority().drive_velocity(now());
  return driven ? *driven : missions_.search_velocity();
}

void RobotLoop::publish() {
  localiser_.note_pose(now());
  missions_.keep_checkpoint();
  localiser_.map().step();
  if (world_.take_loss()) {
    publisher_.republish();
  }
  publisher_.publish();
}

void RobotLoop::publish_idle() {
  if (hooks_.on_idle) {
    hooks_.on_idle();
  }
  sensing_.mark_as_used();
  localiser_.map().step();
  publisher_.publish();
}

bool RobotLoop::await(Duration limit, WallTime wall_now) {
  const Result<bool> there = world_.await(limit);
  watch_world(wall_now);
  commands_.watch(wall_now);
  if (!there) {
    end_source(there.error());
  }
  if (hooks_.on_pass) {
    hooks_.on_pass(wall_now);
  }
  return !there || *there;
}

void RobotLoop::watch_world(WallTime wall_now) {
  const Status there = world_.watch(wall_now);
  if (!there && executor_.running()) {
    executor_.end(api::Outcome::kFault, there.error().message, WorldLink::remedy_for(there.error()), now());
    publisher_.republish();
  }
  if (world_.take_loss()) {
    publisher_.republish();
  }
  if (world_.lost() && publisher_.republishes()) {
    publisher_.publish();
  }
}

void RobotLoop::end_source(const Error& error) {
  if (!world_.end()) {
    return;
  }
  const api::Fault* fault = diagnostics_.faults().blocking();
  executor_.end(api::Outcome::kFault, error.message, fault != nullptr ? fault->remedy : "", now());
  const std::string summary = devices_.summary ? devices_.summary() : "";
  diagnostics_.log("source-ended", summary.empty() ? error.message : summary);
  publisher_.republish();
  publisher_.publish();
}

std::vector<std::string> RobotLoop::capabilities() const {
  return app::capabilities(devices_, localiser_.map().has_segments());
}

}  // namespace seeker::app
