// What the robot's devices tell, and where it is by that (RobotLoop).
#include <chrono>
#include <cmath>
#include <utility>

#include "server/app/loop/robot_loop.hpp"

namespace seeker::app {
namespace {

Status check(const drivers::OdometrySample& sample) {
  if (!is_finite(sample.odom_T_base) || !std::isfinite(sample.velocity.v_m_s) ||
      !std::isfinite(sample.velocity.omega_rad_s)) {
    return fail(Errc::kInvalidArgument, "the odometry is not a finite number; check the base's cable");
  }
  return {};
}

Status check(const LaserScan& scan) { return validate(scan); }
Status check(const SonarScan& scan) { return validate(scan); }

}  // namespace

template <class Driver, class Sample>
void RobotLoop::read(Driver* driver, const std::string& name, Duration timeout, std::optional<Sample>& latest,
                     bool& fresh, RobotTime& last) {
  fresh = false;
  if (driver == nullptr || !components_.active(name)) {
    return;
  }
  Result<std::optional<Sample>> sample = driver->read();
  const Status ok = !sample ? Status(tl::unexpected<Error>(sample.error())) : *sample ? check(**sample) : Status();
  if (!ok && !world_there()) {
    return;
  }
  if (!ok) {
    raise(name + "-invalid", name, name + ": " + ok.error().message,
          "mend the device, then 'seeker components --restart " + name + "'");
  } else if (*sample) {
    latest = std::move(**sample);
    last = now();
    fresh = true;
    components_.count_output(name, last);
    clear(name + "-invalid");
    clear(name + "-silent");
  }
  if (now() - last > timeout && !ended_) {
    raise(name + "-silent", name,
          "the " + name + " has been silent for more than " +
              std::to_string(std::chrono::duration_cast<std::chrono::milliseconds>(timeout).count()) + " ms",
          "check its cable and power; 'seeker components --restart " + name + "' starts it again");
  }
}

void RobotLoop::sense() {
  read(parts_.devices.base.get(), "base", params_.base_timeout, odometry_, fresh_odometry_, last_odometry_);
  if (fresh_odometry_) {
    continue_odometry(*odometry_);
    odometry_history_.add(*odometry_);
  }
  read(parts_.devices.lidar.get(), "lidar", params_.lidar_timeout, scan_, fresh_scan_, last_scan_);
  read(parts_.devices.sonar.get(), "sonar", params_.sonar_timeout, sonar_, fresh_sonar_, last_sonar_);
  // A recording cannot be slowed, and is to give the map that it gives offline.
  if (fresh_scan_ && odometry_ && !parts_.devices.runs_without_mission) {
    seen_movers_.look(*scan_, odometry_history_.at(scan_->stamp)->odom_T_base, now());
  }
}

void RobotLoop::note_reading(const Status& status, const char* id) {
  if (!status) {
    raise(id, "pose", status.error().message, "the estimate goes on without this reading", api::Severity::kWarning);
  } else {
    clear(id);
  }
}

const LaserScan* RobotLoop::tell_estimator() {
  const auto tell = [this](const drivers::OdometrySample& sample) {
    told_odometry_ = sample.stamp;
    note_reading(parts_.estimator->on_odometry(sample), "odometry-refused");
  };
  const bool late = fresh_odometry_ && fresh_scan_ && scan_->stamp < odometry_->stamp;
  const std::optional<drivers::OdometrySample> then = late ? odometry_history_.at(scan_->stamp) : odometry_;
  if (fresh_odometry_ && (!late || then->stamp > told_odometry_)) {
    tell(*then);
  }
  const LaserScan* building = nullptr;
  if (fresh_scan_) {
    building = &scan_of_building();
    note_reading(parts_.estimator->on_scan(*building), "scan-refused");
  }
  if (late) {
    tell(*odometry_);
  }
  return building;
}

void RobotLoop::estimate() {
  const LaserScan* building = tell_estimator();
  if (fresh_odometry_ || fresh_scan_) {
    std::optional<Pose2> by_odometry;
    if (odom_T_base_at_pose_ && odometry_) {
      by_odometry = pose_.map_T_base * (inverse(*odom_T_base_at_pose_) * odometry_->odom_T_base);
    }
    follow_map(by_odometry);
    odom_T_base_at_pose_ = odometry_ ? std::optional<Pose2>(odometry_->odom_T_base) : std::nullopt;
    components_.count_output("pose", now());
  }
  if (!is_placed(pose_.quality)) {
    return;
  }
  if (building != nullptr) {
    note_reading(map_.integrate(*building, pose_.map_T_base * odometry_history_.now_T_then(building->stamp)),
                 "map-full");
  } else if (fresh_sonar_ && parts_.devices.lidar == nullptr) {
    note_reading(map_.integrate(*sonar_, pose_.map_T_base * odometry_history_.now_T_then(sonar_->stamp)), "map-full");
  }
}

}  // namespace seeker::app
