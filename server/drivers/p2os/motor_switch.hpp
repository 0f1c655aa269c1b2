/// \file
/// Switches the motors of a base on and off, until its information shows that it obeyed.
#pragma once

#include <optional>

#include "common/core/result.hpp"
#include "common/core/time.hpp"
#include "server/drivers/p2os/packet_line.hpp"

namespace seeker::drivers {

/// ENABLE is repeated a few times while the base does not show the wanted state. Motors that are switched off at the
/// base stay off until they are commanded on again: whoever pressed the button stands beside it.
class MotorSwitch {
 public:
  void want(bool on, RobotTime now);
  /// A connection begins with the motors off; the wanted state is commanded again.
  void connect(RobotTime now);
  /// The base's information shows whether its motors are on.
  void show(bool on);
  /// Sends what is due.
  void pass(RobotTime now, PacketLine& line);
  [[nodiscard]] RobotTime wake() const;

  [[nodiscard]] bool on() const { return shown_on_; }
  /// The motors are off though they were commanded on, and why.
  [[nodiscard]] std::optional<Error> fault() const;

 private:
  bool wanted_on_ = false;
  bool shown_on_ = false;
  bool obeyed_ = false;  ///< the base has shown the wanted state since it was commanded
  int sends_left_ = 0;
  RobotTime next_send_;
};

}  // namespace seeker::drivers
