#include "server/app/loop/motion_control.hpp"

#include <utility>

namespace seeker::app {

MotionControl::MotionControl(const SafetyParams& params, const WheelCalibration& calibration,
                             std::shared_ptr<drivers::BaseDriver> base, const Sensing& sensing,
                             const SituationSource& situation, WorldLink& world, Diagnostics& diagnostics)
    : params_(params),
      calibration_(calibration),
      base_(std::move(base)),
      sensing_(sensing),
      situation_(situation),
      world_(world),
      diagnostics_(diagnostics),
      authority_(params.lease) {}

SafetyVerdict MotionControl::verdict_on(const Twist2& wanted) const {
  if (diagnostics_.components().stopped("safety")) {
    return {.allowed = {}, .reason = "the safety supervisor is not active"};
  }
  const LaserScan* scan = sensing_.scan_for(sensing_.connections().safety);
  const SonarScan* sonar = sensing_.sonar_for(sensing_.connections().safety);
  const OdometryHistory& history = sensing_.history();
  // Ahead the laser looks by itself.
  const bool backwards = wanted.v_m_s < 0.0;
  return supervise(
      {.wanted = wanted,
       .may_be_cut = authority_.drive_velocity(world_.now()).has_value(),
       .armed = authority_.armed(),
       .estop = authority_.estop(),
       .blocking = diagnostics_.faults().blocking(),
       .scan = scan,
       .sonar = sonar,
       .base_T_scan = scan != nullptr ? history.now_T_then(scan->stamp) : Pose2{},
       .base_T_sonar = sonar != nullptr ? history.now_T_then(sonar->stamp) : Pose2{},
       .velocity = sensing_.velocity(),
       .movers_base = situation_.movers_base(),
       .remembered_base = backwards ? recent_.in_base(sensing_.odom_T_base(), world_.now()) : std::vector<Point2>()},
      params_);
}

void MotionControl::look_around() {
  const drivers::OdometrySample* odometry = sensing_.new_odometry();
  if (odometry != nullptr && odometry->discontinued) {
    recent_.forget();
  }
  const LaserScan* scan = sensing_.new_scan();
  if (scan != nullptr && sensing_.motion_known() && sensing_.odometry() != nullptr) {
    recent_.see(*scan, sensing_.history().at(scan->stamp)->odom_T_base);
  }
}

Twist2 MotionControl::commanded(const Twist2& velocity) const {
  // Without errors to correct the command is passed on bit by bit.
  return is_identity(calibration_) ? velocity : reported(velocity, calibration_);
}

void MotionControl::act(const Twist2& wanted) {
  const bool arm = authority_.armed() && diagnostics_.faults().blocking() == nullptr;
  const SafetyVerdict verdict = verdict_on(wanted);
  safety_reason_ = verdict.reason;
  diagnostics_.components().count_output("safety", "velocity", world_.now());
  if (!diagnostics_.components().active("base") || !base_->drivable()) {
    return;
  }
  if (arm != motors_on_) {
    // The base holds its velocity: one that misses the command to power off is to stand, too.
    if (const Status ok = arm ? Status() : base_->set_velocity({}, world_.now()); !ok) {
      refused(ok.error());
      return;
    }
    if (const Status ok = base_->set_motors(arm); !ok) {
      refused(ok.error());
      return;
    }
    motors_on_ = arm;
  }
  if (!motors_on_ && verdict.allowed == Twist2{}) {
    return;
  }
  if (const Status ok = base_->set_velocity(commanded(verdict.allowed), world_.now()); !ok) {
    refused(ok.error());
  }
}

void MotionControl::refused(const Error& error) {
  if (world_.check()) {
    diagnostics_.raise("base-refused", "base", "base: " + error.message, "'seeker components --restart base'");
  }
}

void MotionControl::stop() {
  authority_.stop();
  act({});
}

bool MotionControl::set_estop(bool engaged, const std::string& client) {
  if (engaged == authority_.estop()) {
    return false;
  }
  authority_.set_estop(engaged);
  const std::string by = client.empty() ? "" : " by '" + client + "'";
  diagnostics_.log(engaged ? "estop" : "estop-released",
                   (engaged ? "emergency stop latched" : "emergency stop released") + by,
                   engaged ? api::Severity::kCritical : api::Severity::kInfo);
  return true;
}

void MotionControl::halt() {
  if (diagnostics_.components().active("base")) {
    // Nothing can be done here about a base that does not answer: its own time-out halts it.
    static_cast<void>(base_->set_velocity({}, world_.now()));
    static_cast<void>(base_->set_motors(false));
  }
}

void MotionControl::restarted(const std::string& component) {
  authority_.disarm();
  if (component == "base") {
    motors_on_ = false;
  }
}

}  // namespace seeker::app
