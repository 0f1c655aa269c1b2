#include "server/app/loop/robot_loop.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/angle.hpp"

namespace seeker::app {
namespace {

/// Below this the base stands still.
constexpr double kStill_m_s = 1e-3;
constexpr double kStill_rad_s = 1e-3;

Result<Recognition> recognise(const vision::Recogniser& recogniser, const Image& picture, Recognition context) {
  Result<vision::RecognitionReport> report = recogniser.recognise(picture);
  if (!report) {
    return tl::unexpected<Error>(report.error());
  }
  context.sightings = std::move(report->sightings);
  return context;
}

}  // namespace

RobotLoop::RobotLoop(const LoopParams& params, LoopParts parts, UpdateHub& hub)
    : params_(params),
      parts_(std::move(parts)),
      hub_(hub),
      missions_(params.mission, parts_.behaviours,
                {.event = [this](const api::Event& event) { emit(event); },
                 .status =
                     [this](const api::MissionStatus& status) {
                       if (on_mission) {
                         on_mission(status);
                       }
                       if (status.end) {
                         drop_checkpoints();
                       }
                       hub_.publish(api::Topic::kMission, now(), status);
                     },
                 .detection =
                     [this](const api::Detection& detection) {
                       if (on_detection) {
                         on_detection(detection);
                       }
                       hub_.publish(api::Topic::kDetection, now(), detection);
                     }}),
      recognition_(parts_.devices.clock->lockstep(), "the recogniser failed on a picture"),
      looks_(parts_.devices.clock->lockstep(), "a stereo picture could not be looked at"),
      map_(params.map, parts_.occupancy, parts_.estimator->map_tracker()) {
  register_components();
}

RobotLoop::~RobotLoop() { shut_down(); }

void RobotLoop::register_components() {
  const auto driver = [this](const std::string& name, drivers::Driver* device) {
    if (device != nullptr) {
      components_.add(name, "driver", parts_.devices.type,
                      {[device] { return device->activate(); }, [device] { device->deactivate(); }});
    }
  };
  driver("base", parts_.devices.base.get());
  driver("lidar", parts_.devices.lidar.get());
  driver("sonar", parts_.devices.sonar.get());
  driver("camera", parts_.devices.camera.get());
  driver("stereo", parts_.devices.stereo.get());
  components_.add("pose", "estimator", parts_.estimator_type, {});
  components_.add("mission", "behaviour", "executor", {});
  components_.add("recogniser", "recogniser", "template+features", {});
  components_.add("safety", "supervisor", "clearance", {});
}

void RobotLoop::start() {
  components_.activate_all();
  last_odometry_ = last_scan_ = last_sonar_ = now();
  for (const api::ComponentInfo& info : components_.list(now())) {
    if (info.state == api::ComponentState::kError) {
      raise(info.name + "-failed", info.name, info.name + " did not start: " + info.last_error,
            "mend the cause, then 'seeker components --restart " + info.name + "'");
    }
  }
  sense();
  estimate();
  remember_pose();
}

void RobotLoop::shut_down() {
  if (components_.active("base")) {
    // Nothing can be done here about a base that does not answer: its own time-out halts it.
    static_cast<void>(parts_.devices.base->set_velocity({}, now()));
    static_cast<void>(parts_.devices.base->set_motors(false));
  }
  components_.deactivate_all();
  let_world_go();
}

bool RobotLoop::realtime() const { return !parts_.devices.clock->lockstep() || parts_.devices.clock->speed() == 1.0; }

bool RobotLoop::idle() const {
  if (ended_) {
    return true;
  }
  // A robot that looks for its place needs scans; a map that is written anew is to be finished.
  const bool settled = map_.settled() && !map_.relocalising() && !resuming_;
  return !realtime() && !parts_.devices.runs_without_mission && !missions_.running() && !moving() && settled;
}

bool RobotLoop::moving() const {
  return odometry_ &&
         (std::abs(odometry_->velocity.v_m_s) > kStill_m_s || std::abs(odometry_->velocity.omega_rad_s) > kStill_rad_s);
}

void RobotLoop::tick(WallTime wall_now) {
  sense();
  estimate();
  resume_when_found();
  act(decide(wall_now));
  remember_pose();
  keep_checkpoint();
  map_.step();
  publish();
  if (const Status advanced = parts_.devices.clock->advance(params_.period); !advanced) {
    end_source(advanced.error());
  }
}

bool RobotLoop::await(Duration limit, WallTime wall_now) {
  const Result<bool> there = parts_.devices.clock->await(limit);
  watch_world(wall_now);
  if (!there) {
    end_source(there.error());
  }
  return !there || *there;
}

void RobotLoop::end_source(const Error& error) {
  if (ended_) {
    return;
  }
  ended_ = true;
  const api::Fault* fault = faults_.blocking();
  missions_.end(api::Outcome::kFault, error.message, fault != nullptr ? fault->remedy : "", now());
  const std::string summary = parts_.devices.summary ? parts_.devices.summary() : "";
  log("source-ended", summary.empty() ? error.message : summary);
  republish_ = true;
  publish();
}

Situation RobotLoop::situation() const {
  Situation s;
  s.now = now();
  s.pose = pose_;
  s.velocity = odometry_ ? odometry_->velocity : Twist2{};
  s.scan = scan_ ? &*scan_ : nullptr;
  s.sonar = sonar_ ? &*sonar_ : nullptr;
  s.map = &map_.occupancy();
  s.tracker = parts_.estimator->map_tracker();
  s.map_is_read_only = map_.identity().use == api::MapUse::kLocalise;
  s.battery_v = odometry_ ? odometry_->battery_v : std::nullopt;
  s.odom_T_base = odometry_ ? odometry_->odom_T_base : Pose2{};
  s.map_name = map_.identity().name;
  s.has_stereo = parts_.devices.stereo != nullptr && parts_.stereo != nullptr;
  s.fleet = fleet_ ? &*fleet_ : nullptr;
  s.movers = nav::moved(movers_base(pose_.map_T_base), pose_.map_T_base);
  return s;
}

Twist2 RobotLoop::decide(WallTime wall_now) {
  take_recognition();
  take_look();
  const Situation here = situation();
  const Decision decision = missions_.step(here, faults_.blocking(), wall_now);
  note_topology();
  if (decision.wants_image && missions_.running()) {
    look();
  }
  if (decision.place) {
    place_at(*decision.place);
  }
  const bool for_mission = decision.wants_look && missions_.running();
  if (for_mission || parts_.estimator->wants_look(now())) {
    look_for_mission_ = look_for_mission_ || for_mission;
    look_with_both();
  }
  if (missions_.running()) {
    authority_.cancel_drive();
    return decision.command;
  }
  const std::optional<Twist2> driven = authority_.drive_velocity(now());
  return driven ? *driven : resuming_ ? look_round() : Twist2{};
}

void RobotLoop::look() {
  const Behaviour* behaviour = missions_.behaviour();
  const auto recogniser = behaviour != nullptr ? behaviour->recogniser() : nullptr;
  if (recogniser == nullptr || recognition_.busy() || parts_.devices.camera == nullptr) {
    return;
  }
  Result<CameraFrame> frame = parts_.devices.camera->grab();
  if (!frame && !world_there()) {
    return;
  }
  if (!frame) {
    raise("camera-failed", "camera", "camera: " + frame.error().message,
          "check the camera, then 'seeker components --restart camera'");
    return;
  }
  clear("camera-failed");
  components_.count_output("camera", now());
  if (hub_.wanted(api::Topic::kImage)) {
    hub_.publish(
        api::Topic::kImage, now(),
        api::ImageFrame{.camera = parts_.devices.camera_name, .frame = *frame, .map_T_base = pose_.map_T_base});
  }
  Recognition context;
  context.stamp = frame->stamp;
  context.map_T_base = pose_.map_T_base;
  context.scan = scan_;
  context.sonar = sonar_;
  recognition_.start([recogniser, context = std::move(context), picture = std::move(frame->image)] {
    return recognise(*recogniser, picture, context);
  });
  take_recognition();  // inline: the answer is there at once
}

void RobotLoop::take_recognition() {
  const std::optional<Result<Recognition>> answer = recognition_.take();
  if (!answer) {
    return;
  }
  if (*answer) {
    components_.count_output("recogniser", now());
    missions_.on_recognition(**answer);
  } else {
    raise("recogniser-failed", "recogniser", answer->error().message,
          "check the camera's picture with 'seeker camera grab'", api::Severity::kWarning);
  }
}

void RobotLoop::act(const Twist2& wanted) {
  const bool arm = authority_.armed() && faults_.blocking() == nullptr;
  const SafetyVerdict verdict =
      supervise({.wanted = wanted,
                 .armed = authority_.armed(),
                 .estop = authority_.estop(),
                 .blocking = faults_.blocking(),
                 .scan = scan_ ? &*scan_ : nullptr,
                 .sonar = sonar_ ? &*sonar_ : nullptr,
                 .base_T_scan = scan_ ? odometry_history_.now_T_then(scan_->stamp) : Pose2{},
                 .base_T_sonar = sonar_ ? odometry_history_.now_T_then(sonar_->stamp) : Pose2{},
                 .velocity = odometry_ ? odometry_->velocity : Twist2{},
                 .movers_base = movers_base(pose_.map_T_base)},
                params_.safety);
  safety_reason_ = verdict.reason;
  command_ = verdict.allowed;
  if (!components_.active("base") || !parts_.devices.base->drivable()) {
    return;
  }
  if (arm != motors_on_) {
    if (const Status ok = parts_.devices.base->set_motors(arm); !ok) {
      base_refused(ok.error());
      return;
    }
    motors_on_ = arm;
  }
  if (!motors_on_ && command_ == Twist2{}) {
    return;
  }
  if (const Status ok = parts_.devices.base->set_velocity(command_, now()); !ok) {
    base_refused(ok.error());
  }
}

void RobotLoop::raise(const std::string& id, const std::string& component, const std::string& message,
                      const std::string& remedy, api::Severity severity) {
  if (faults_.raise({.id = id,
                     .component = component,
                     .severity = severity,
                     .onset = now(),
                     .message = message,
                     .remedy = remedy})) {
    log("fault", id + ": " + message, severity);
  }
}

void RobotLoop::clear(const std::string& id) {
  if (faults_.clear(id)) {
    log("fault-cleared", id);
  }
}

void RobotLoop::log(const std::string& kind, const std::string& text, api::Severity severity) {
  emit({.sequence = 0,
        .stamp = now(),
        .mission_time = std::nullopt,
        .mission = "",
        .severity = severity,
        .kind = kind,
        .text = text});
}

void RobotLoop::emit(const api::Event& event) {
  api::Event numbered = event;
  numbered.sequence = ++event_sequence_;
  if (on_event) {
    on_event(event);
  }
  hub_.publish(api::Topic::kEvent, event.stamp, std::move(numbered));
}

}  // namespace seeker::app
