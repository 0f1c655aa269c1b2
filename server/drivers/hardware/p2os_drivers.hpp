/// \file
/// A Pioneer base as the robot's base and its sonar ring.
#pragma once

#include <memory>

#include "server/drivers/interfaces/drivers.hpp"
#include "server/drivers/link/device_thread.hpp"
#include "server/drivers/p2os/p2os_session.hpp"

namespace seeker::drivers {

/// The base's session on its line. The base owns its line; the sonar ring reads what comes with it.
class P2osLink {
 public:
  /// `params` are valid.
  P2osLink(const P2osParams& params, DeviceThreadParams line, std::shared_ptr<const Clock> clock);

  [[nodiscard]] DeviceThread& thread() { return thread_; }
  [[nodiscard]] const DeviceThread& thread() const { return thread_; }
  [[nodiscard]] P2osSession& session() { return *session_; }
  [[nodiscard]] const P2osSession& session() const { return *session_; }
  [[nodiscard]] RobotTime now() const { return clock_->now(); }

 private:
  std::shared_ptr<const Clock> clock_;
  std::shared_ptr<P2osSession> session_;
  DeviceThread thread_;
};

class P2osBase final : public BaseDriver {
 public:
  explicit P2osBase(std::shared_ptr<P2osLink> link) : link_(std::move(link)) {}
  ~P2osBase() override { deactivate(); }

  [[nodiscard]] Status activate() override;
  void deactivate() override;
  /// Each read shows the base that the robot's loop is alive.
  [[nodiscard]] Result<std::optional<OdometrySample>> read() override;
  [[nodiscard]] Status set_velocity(const Twist2& velocity, RobotTime now) override;
  [[nodiscard]] Status set_motors(bool enabled) override;
  /// "lost": no link. "halted": the emergency stop or the charger holds the base, or, without blocking the robot, a
  /// bumper or a stalled wheel does: the session refuses what may not be, and the robot must be able to back away.
  [[nodiscard]] std::vector<DeviceFault> faults() const override;
  [[nodiscard]] std::optional<LinkStatistics> statistics() const override { return link_->thread().statistics(); }

 private:
  std::shared_ptr<P2osLink> link_;
};

/// Works while the base does.
class P2osSonar final : public SonarDriver {
 public:
  explicit P2osSonar(std::shared_ptr<P2osLink> link) : link_(std::move(link)) {}

  [[nodiscard]] Status activate() override;
  void deactivate() override { active_ = false; }
  [[nodiscard]] Result<std::optional<SonarScan>> read() override;

 private:
  std::shared_ptr<P2osLink> link_;
  bool active_ = false;
};

}  // namespace seeker::drivers
