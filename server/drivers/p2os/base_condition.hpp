/// \file
/// What keeps a base from moving: bumpers, stalled wheels, the emergency stop, the charger (protocols 1.6).
#pragma once

#include <cstdint>
#include <optional>

#include "common/core/pose2.hpp"
#include "common/core/result.hpp"
#include "server/drivers/p2os/p2os_params.hpp"
#include "server/protocols/p2os/sip.hpp"

namespace seeker::drivers {

class BaseCondition {
 public:
  /// `params` must outlive it.
  explicit BaseCondition(const P2osParams& params) : params_(params) {}

  /// A connection begins: nothing is known of the base.
  void connect();
  /// True: something keeps the base from moving that did not before, and it must be halted at once. `commanded` is the
  /// motion that was commanded.
  [[nodiscard]] bool update(const p2os::Sip& sip, const Twist2& commanded);

  /// The part of a motion that is allowed now. Away from a pressed bumper, and against the direction in which the
  /// wheels stalled, the base may move.
  [[nodiscard]] Twist2 allowed(const Twist2& wanted) const;
  /// What keeps the base from moving, and the remedy: kNotReady where it may not move at all, kRefused where it may in
  /// other directions.
  [[nodiscard]] std::optional<Error> fault() const;

  [[nodiscard]] bool bumped() const { return front_ || rear_; }
  [[nodiscard]] bool stalled() const { return stalled_; }

 private:
  /// Whether it may not move at all.
  [[nodiscard]] bool held() const { return e_stop_ || e_stall_ || charging_; }

  const P2osParams& params_;
  bool front_ = false;  ///< bumpers
  bool rear_ = false;
  bool stalled_ = false;
  Twist2 stalled_by_;  ///< the motion in which the wheels stalled
  bool e_stop_ = false;
  bool e_stall_ = false;
  bool charging_ = false;
};

}  // namespace seeker::drivers
