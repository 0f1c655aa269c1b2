#include "server/app/loop/sensing.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "common/core/scan_motion.hpp"

namespace seeker::app {
namespace {

/// Below this the base stands still.
constexpr double kStill_m_s = 1e-3;
constexpr double kStill_rad_s = 1e-3;

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

Sensing::Sensing(const LoopParams& params, const Devices& devices, WorldLink& world, Diagnostics& diagnostics)
    : timeouts_{params.base_timeout, params.lidar_timeout, params.sonar_timeout},
      connections_(params.connections),
      devices_(devices),
      world_(world),
      diagnostics_(diagnostics),
      calibrator_(params.odometry_calibration) {}

template <class Driver, class Sample>
bool Sensing::read(Driver* driver, const std::string& name, const char* port, Duration timeout,
                   std::optional<Sample>& latest, RobotTime& last) {
  Components& components = diagnostics_.components();
  if (driver == nullptr || !components.active(name)) {
    return false;
  }
  Result<std::optional<Sample>> sample = driver->read();
  const Status ok = !sample ? Status(tl::unexpected<Error>(sample.error())) : *sample ? check(**sample) : Status();
  if (!ok && !world_.check()) {
    return false;
  }
  const RobotTime now = world_.now();
  const bool fresh = ok && *sample;
  if (!ok) {
    diagnostics_.raise(name + "-invalid", name, name + ": " + ok.error().message,
                       "mend the device, then 'seeker components --restart " + name + "'");
  } else if (fresh) {
    latest = std::move(**sample);
    last = now;
    components.count_output(name, port, last);
    diagnostics_.clear(name + "-invalid");
    diagnostics_.clear(name + "-silent");
  }
  if (now - std::max(last, world_.back_at()) > timeout && !world_.ended()) {
    diagnostics_.raise(name + "-silent", name,
                       "the " + name + " has been silent for more than " +
                           std::to_string(std::chrono::duration_cast<std::chrono::milliseconds>(timeout).count()) +
                           " ms",
                       "check its cable and power; 'seeker components --restart " + name + "' starts it again");
  }
  return fresh;
}

void Sensing::note_faults(const drivers::Driver* driver, const std::string& name) {
  std::set<std::string>& raised = device_faults_[name];
  std::set<std::string> gone = std::exchange(raised, {});
  if (driver != nullptr && diagnostics_.components().active(name)) {
    for (const drivers::DeviceFault& fault : driver->faults()) {
      const std::string id = name + "-" + fault.id;
      diagnostics_.raise(id, name, fault.message, fault.remedy,
                         fault.blocking ? api::Severity::kError : api::Severity::kWarning);
      raised.insert(id);
      gone.erase(id);
    }
  }
  for (const std::string& id : gone) {
    diagnostics_.clear(id);
  }
}

void Sensing::read() {
  note_faults(devices_.base.get(), "base");
  note_faults(devices_.lidar.get(), "lidar");
  note_faults(devices_.sonar.get(), "sonar");
  fresh_odometry_ = read(devices_.base.get(), "base", "odometry", timeouts_.base, measured_odometry_, last_.odometry);
  if (fresh_odometry_) {
    continue_odometry(*measured_odometry_);
    odometry_ = calibrator_.apply(*measured_odometry_);
    history_.add(*odometry_);
  }
  fresh_scan_ = read(devices_.lidar.get(), "lidar", "scan", timeouts_.lidar, scan_, last_.scan);
  if (fresh_scan_) {
    correct_for_motion(*scan_);
  }
  fresh_sonar_ = read(devices_.sonar.get(), "sonar", "echoes", timeouts_.sonar, sonar_, last_.sonar);
}

void Sensing::correct_for_motion(LaserScan& scan) const {
  if (scan.sweep != Duration::zero() && history_.predicted_at(scan.stamp)) {
    scan = corrected_for_motion(scan, [&](RobotTime at) { return *history_.predicted_at(at); });
  }
}

void Sensing::mark_as_new() {
  fresh_odometry_ = odometry_.has_value();
  fresh_scan_ = scan_.has_value();
  fresh_sonar_ = sonar_.has_value();
}

void Sensing::forget(const std::string& name) {
  if (name == "lidar") {
    scan_.reset();
    fresh_scan_ = false;
  } else if (name == "sonar") {
    sonar_.reset();
    fresh_sonar_ = false;
  }
}

void Sensing::restart_patience() {
  const RobotTime now = world_.now();
  last_ = {now, now, now};
}

void Sensing::base_restarted() {
  odom_T_restart_ = measured_odometry_ ? std::optional(measured_odometry_->odom_T_base) : std::nullopt;
}

void Sensing::continue_odometry(drivers::OdometrySample& sample) {
  if (odom_T_restart_) {
    odom_T_counted_ = *odom_T_restart_ * inverse(sample.odom_T_base);
    odom_T_restart_.reset();
  }
  if (odom_T_counted_) {
    sample.odom_T_base = *odom_T_counted_ * sample.odom_T_base;
  }
}

bool Sensing::motion_known() const {
  const auto faults = device_faults_.find("base");
  const bool lost = faults != device_faults_.end() && faults->second.count("base-lost") > 0;
  return !lost && (!odometry_ || world_.now() - last_.odometry <= timeouts_.base);
}

bool Sensing::moving() const {
  return odometry_ &&
         (std::abs(odometry_->velocity.v_m_s) > kStill_m_s || std::abs(odometry_->velocity.omega_rad_s) > kStill_rad_s);
}

}  // namespace seeker::app
