/// \file
/// What an emulated base feels: its wheels, bumpers, battery, charger and emergency stop.
#pragma once

#include <cstdint>
#include <optional>

#include "common/core/time.hpp"
#include "server/emulator/devices/p2os_device_params.hpp"
#include "server/emulator/devices/pioneer_motion.hpp"
#include "server/protocols/p2os/pioneer_model.hpp"
#include "server/protocols/p2os/sip.hpp"
#include "server/sim/robot_in_world.hpp"

namespace seeker::emulator {

class PioneerBody {
 public:
  /// `params` and `model` must outlive it.
  PioneerBody(const P2osDeviceParams& params, const p2os::PioneerModel& model) : params_(params), model_(model) {}

  /// The simulated robot feels this. `bearing_rad` leads to the obstacle that it touches, if known; otherwise it is
  /// where `motion` was going.
  void feel(const sim::BaseReading& reading, std::optional<double> bearing_rad, const PioneerMotion& motion);
  /// Takes the motors' power for the wait after a stall if they are driven against something. `bump_stall` is the
  /// argument of BUMPSTALL.
  void watch_for_stalls(const PioneerMotion& motion, bool driven, int bump_stall, RobotTime now);
  /// A wheel is stalled, and the motors have no power.
  [[nodiscard]] bool stalled() const { return stalled_at_.has_value(); }

  void set_faults(const P2osFaults& faults) { faults_ = faults; }
  [[nodiscard]] const P2osFaults& faults() const { return faults_; }
  [[nodiscard]] const sim::BaseReading& reading() const { return reading_; }
  /// Writes all that is felt into a packet.
  void show(p2os::Sip& sip) const;

 private:
  [[nodiscard]] std::uint8_t pressed_bumpers(bool front) const;
  [[nodiscard]] bool bump_stalls(const PioneerMotion& motion, int bump_stall) const;
  void show_motion(p2os::Sip& sip) const;
  void show_power(p2os::Sip& sip) const;

  const P2osDeviceParams& params_;
  const p2os::PioneerModel& model_;
  P2osFaults faults_;
  sim::BaseReading reading_;
  bool contact_in_front_ = true;  ///< of the present contact
  std::optional<RobotTime> stalled_at_;
  bool left_stalled_ = false;
  bool right_stalled_ = false;
};

}  // namespace seeker::emulator
