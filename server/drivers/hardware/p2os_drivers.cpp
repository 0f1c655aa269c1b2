#include "server/drivers/hardware/p2os_drivers.hpp"

#include <cmath>
#include <utility>

#include "server/drivers/hardware/device_faults.hpp"

namespace seeker::drivers {

P2osLink::P2osLink(const P2osParams& params, DeviceThreadParams line, std::shared_ptr<const Clock> clock)
    : clock_(std::move(clock)),
      session_(std::make_shared<P2osSession>(params)),
      thread_("base", std::move(line), session_, [this] { return clock_->now(); }) {}

Status P2osBase::activate() {
  link_->thread().start();
  return {};
}

void P2osBase::deactivate() { link_->thread().stop(); }

Result<std::optional<OdometrySample>> P2osBase::read() {
  const RobotTime now = link_->now();
  return link_->thread().with([&] {
    link_->session().loop_alive(now);
    return link_->session().take_odometry();
  });
}

Status P2osBase::set_velocity(const Twist2& velocity, RobotTime /*now*/) {
  if (!std::isfinite(velocity.v_m_s) || !std::isfinite(velocity.omega_rad_s)) {
    return fail(Errc::kInvalidArgument, "the velocity is not a finite number");
  }
  const RobotTime now = link_->now();
  link_->thread().with([&] { link_->session().set_velocity(velocity, now); });
  return {};
}

Status P2osBase::set_motors(bool enabled) {
  const RobotTime now = link_->now();
  link_->thread().with([&] { link_->session().set_motors(enabled, now); });
  return {};
}

std::vector<DeviceFault> P2osBase::faults() const {
  std::vector<DeviceFault> faults = faults_of(link_->thread().state(), std::nullopt);
  if (const auto halted = link_->thread().look([&] { return link_->session().base_fault(); })) {
    faults.push_back(fault_of("halted", *halted, halted->code == Errc::kNotReady));
  }
  return faults;
}

Status P2osSonar::activate() {
  active_ = true;
  return {};
}

Result<std::optional<SonarScan>> P2osSonar::read() {
  std::optional<SonarScan> scan = link_->thread().with([&] { return link_->session().take_sonar(); });
  return active_ ? std::move(scan) : std::nullopt;
}

}  // namespace seeker::drivers
