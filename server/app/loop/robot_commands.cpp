#include "server/app/loop/robot_loop.hpp"

namespace seeker::app {

Result<api::MissionId> RobotLoop::start_mission(const api::MissionRequest& request, const std::string& client) {
  if (authority_.estop()) {
    return fail(Errc::kRefused, "the emergency stop is latched; release it with 'seeker estop --release'");
  }
  const api::LeaseState& lease = authority_.lease();
  if (!lease.owner.empty() && lease.owner != client) {
    return fail(Errc::kRefused, "'" + lease.owner +
                                    "' holds the lease; wait until it is released, or free it with "
                                    "'seeker drive 0 0 --take-over'");
  }
  if (const Status able = able_to(request.task); !able) {
    return tl::unexpected<Error>(able.error());
  }
  const bool lost = map_.has_segments() && pose_.quality == LocalisationQuality::kLost;
  // Who looks for landmarks wants to know where a lost robot is.
  if (map_.relocalising() || (lost && !std::holds_alternative<api::LocaliseMission>(request.task))) {
    return fail(Errc::kNotReady, "the robot does not know where it is in the map" +
                                     (pose_.cause.empty() ? std::string() : " (" + pose_.cause + ")") +
                                     "; 'seeker relocalise --wait' looks for it, --at X,Y,DEG helps");
  }
  const bool goes_on = unfinished_ && unfinished_->id == request.id;
  Result<api::MissionId> id = missions_.start(request, client, situation(), goes_on ? kept_.so_far : MissionSoFar{});
  if (id) {
    authority_.arm();
    if (!has_own_map_ || !goes_on) {
      drop_checkpoints();
    } else if (kept_.topology) {
      missions_.remember(*kept_.topology);
    }
    unfinished_.reset();
    kept_ = {};
    checkpoint_at_ = now();
    checkpoint_map_T_base_ = pose_.map_T_base;
    if (on_mission_started) {
      on_mission_started(request);
    }
  }
  return id;
}

Status RobotLoop::command_mission(api::MissionCommand command, const std::string& client) {
  const bool resume = command == api::MissionCommand::kResume;
  if (resume && authority_.estop()) {
    return fail(Errc::kRefused, "the emergency stop is latched; release it with 'seeker estop --release'");
  }
  if (resume && resuming_) {
    return fail(Errc::kBusy, "the robot is looking for its place in the map it had; the mission goes on from there");
  }
  if (resume && !missions_.present() && unfinished_) {
    const Result<api::MissionId> again = start_mission(api::MissionRequest(*unfinished_), client);
    return again ? Status() : Status(tl::unexpected<Error>(again.error()));
  }
  if (const Status able = within_reach(); resume && !able) {
    return able;
  }
  const Status done = missions_.command(command, now());
  if (done && resume) {
    authority_.arm();
  }
  return done;
}

void RobotLoop::stop() {
  resuming_ = false;
  missions_.end(api::Outcome::kOperator, "stopped by the operator", "", now());
  authority_.stop();
  act({});
}

void RobotLoop::set_estop(bool engaged) {
  if (engaged == authority_.estop()) {
    return;
  }
  authority_.set_estop(engaged);
  log(engaged ? "estop" : "estop-released", engaged ? "emergency stop latched" : "emergency stop released",
      engaged ? api::Severity::kCritical : api::Severity::kInfo);
  if (engaged) {
    missions_.pause(now(), "emergency stop; release it and resume the mission");
  }
  act({});  // no tick may come to tell why the robot stands now
}

Result<api::LeaseState> RobotLoop::command_lease(const std::string& client, api::LeaseAction action) {
  const std::string before = authority_.lease().owner;
  Result<api::LeaseState> state = authority_.command_lease(client, action);
  if (state && state->owner != before) {
    log("lease", state->owner.empty() ? "the lease is free" : "'" + state->owner + "' holds the lease");
  }
  const bool to_drive = action != api::LeaseAction::kRelease && parts_.devices.base->drivable();
  if (state && state->owner == client && to_drive) {
    authority_.arm();
  }
  return state;
}

Status RobotLoop::drive(const std::string& client, const api::DriveCommand& command) {
  if (const Status drivable = parts_.devices.base->drivable(); !drivable) {
    return drivable;
  }
  if (const Status able = within_reach(); !able) {
    return able;
  }
  if (!realtime()) {
    return fail(Errc::kRefused,
                "the robot's clock runs at another speed than 1, so it cannot be driven by hand; start "
                "it with --set sim.speed=1");
  }
  if (missions_.running()) {
    return fail(Errc::kBusy, "a mission is running; pause or stop it before driving by hand");
  }
  const Status ok = authority_.drive(client, command, now());
  if (ok) {
    authority_.arm();
  }
  return ok;
}

Status RobotLoop::restart_component(const std::string& name) {
  const Status ok = components_.restart(name);
  if (ok) {
    // What moves the robot may have changed: it stays disarmed until somebody moves it again on purpose.
    authority_.disarm();
    if (name == "base") {
      motors_on_ = false;  // as the base begins; no tick may have told it so
      odom_T_restart_ = odometry_ ? std::optional(odometry_->odom_T_base) : std::nullopt;
    }
    missions_.pause(now(), name + " was restarted; resume the mission when the way is clear");
    for (const char* fault : {"-failed", "-invalid", "-silent", "-refused"}) {
      clear(name + fault);
    }
    last_odometry_ = last_scan_ = last_sonar_ = now();
    log("component-restarted", name);
  }
  return ok;
}

Result<api::ImageFrame> RobotLoop::grab_image(const std::string& camera) {
  if (parts_.devices.stereo != nullptr && (camera == "left" || camera == "right")) {
    Result<StereoFrame> frame = parts_.devices.stereo->grab();
    if (!frame) {
      return tl::unexpected<Error>(frame.error());
    }
    Image& eye = camera == "left" ? frame->left : frame->right;
    return api::ImageFrame{.camera = camera, .frame = {frame->stamp, std::move(eye)}, .map_T_base = pose_.map_T_base};
  }
  if (parts_.devices.camera == nullptr || (!camera.empty() && camera != parts_.devices.camera_name)) {
    std::string there = parts_.devices.camera != nullptr ? parts_.devices.camera_name : "";
    there += parts_.devices.stereo != nullptr ? std::string(there.empty() ? "" : ", ") + "left, right" : "";
    return fail(Errc::kNotFound,
                there.empty() ? "this robot has no camera" : "no camera '" + camera + "'; there are: " + there);
  }
  Result<CameraFrame> frame = parts_.devices.camera->grab();
  if (!frame) {
    return tl::unexpected<Error>(frame.error());
  }
  return api::ImageFrame{
      .camera = parts_.devices.camera_name, .frame = std::move(*frame), .map_T_base = pose_.map_T_base};
}

void RobotLoop::client_lost(const std::string& client, const std::string& why, WallTime wall_now) {
  log("link-lost", "'" + client + "': " + why, api::Severity::kWarning);
  authority_.forget(client);
  missions_.client_lost(client, wall_now);
}

void RobotLoop::report_fault(const api::Fault& fault) {
  raise(fault.id, fault.component, fault.message, fault.remedy, fault.severity);
}

void RobotLoop::client_back(const std::string& client) { missions_.client_back(client); }

void RobotLoop::client_closed(const std::string& client) { authority_.forget(client); }

}  // namespace seeker::app
