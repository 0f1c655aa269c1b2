/// \file
/// The velocity commanded to a base, in whole units of the wire (protocols 1.4).
#pragma once

#include <optional>
#include <vector>

#include "common/core/pose2.hpp"
#include "common/core/time.hpp"
#include "server/drivers/p2os/base_condition.hpp"
#include "server/drivers/p2os/base_limits.hpp"
#include "server/drivers/p2os/p2os_params.hpp"
#include "server/drivers/p2os/packet_line.hpp"
#include "server/protocols/p2os/pioneer_model.hpp"

namespace seeker::drivers {

/// A velocity on the wire: VEL and RVEL, or VEL2 with its second number unused.
struct WireVelocity {
  int first = 0;   ///< mm/s, or both wheels
  int second = 0;  ///< deg/s

  friend bool operator==(const WireVelocity&, const WireVelocity&) = default;
};

/// Rounds to mm/s and deg/s; what is not quite zero stays at least one unit.
[[nodiscard]] WireVelocity to_vel(const Twist2& velocity);
/// Rounds to the steps of VEL2; what is not quite zero stays at least one step of each wheel.
[[nodiscard]] WireVelocity to_vel2(const Twist2& velocity, const p2os::PioneerModel& model);

/// Sends a velocity when it changes, and again and again while the base moves, so that a lost packet costs little.
/// Without a newer velocity for a while the base is stopped.
class MotionCommands {
 public:
  /// `params` must outlive it.
  explicit MotionCommands(const P2osParams& params) : params_(params) {}

  /// A connection begins, with the base at rest.
  void connect(const p2os::PioneerModel& model, const BaseLimits& limits);
  void want(const Twist2& velocity, RobotTime now);
  /// Zero velocity is sent with the next pass(), regardless of what was sent before.
  void halt();
  /// The base's information shows whether its wheels turn.
  void show(bool moving) { base_moves_ = moving; }
  /// Sends what is due of the wanted motion that the condition allows.
  void pass(RobotTime now, const BaseCondition& condition, PacketLine& line);
  [[nodiscard]] RobotTime wake() const;

  /// The motion that was commanded last.
  [[nodiscard]] const Twist2& commanded() const { return commanded_; }

 private:
  [[nodiscard]] WireVelocity on_wire(const Twist2& velocity) const;
  void send(const WireVelocity& velocity, bool all, PacketLine& line);
  [[nodiscard]] bool must_repeat() const { return base_moves_ || !(commanded_ == Twist2{}); }

  const P2osParams& params_;
  const p2os::PioneerModel* model_ = nullptr;
  BaseLimits limits_;
  Twist2 wanted_;
  RobotTime wanted_at_;
  Twist2 commanded_;
  std::optional<WireVelocity> sent_;
  RobotTime repeated_at_;  ///< all parts were sent
  bool base_moves_ = false;
};

}  // namespace seeker::drivers
