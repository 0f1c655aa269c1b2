/// \file
/// The talk with a device as a state machine: bytes and time in; bytes, line settings and values out. A session has no
/// thread, no clock and no port, so that every path of a handshake can be tested byte by byte.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "common/core/result.hpp"
#include "common/core/time.hpp"
#include "server/drivers/interfaces/link_statistics.hpp"

namespace seeker::drivers {

/// Writes these bytes to the device.
struct WriteBytes {
  std::vector<std::uint8_t> bytes;
};
/// Changes the rate of a serial line once everything written before has left; other lines ignore it.
struct SetBaud {
  std::uint32_t baud = 0;
};
/// Sets the modem line DTR (the motor of an RPLIDAR A1); lines without one ignore it.
struct SetDtr {
  bool on = false;
};
/// Drops what was received and not yet given to the session.
struct DropInput {};

/// What a session wants done to its line, in this order.
using LineAction = std::variant<WriteBytes, SetBaud, SetDtr, DropInput>;

/// One device's protocol on one line. Times are robot time and never run backwards. After each call the owner carries
/// out take_actions() and calls pass() at wake() at the latest.
class DeviceSession {
 public:
  DeviceSession() = default;
  DeviceSession(const DeviceSession&) = delete;
  DeviceSession& operator=(const DeviceSession&) = delete;
  virtual ~DeviceSession() = default;

  /// The line was opened, for the first time or again: the handshake begins. What must outlive a lost line (the pose by
  /// odometry, the statistics) is kept.
  virtual void open(RobotTime now) = 0;
  /// The line was lost: what was still to be sent would come too late. Until open() the session gets neither bytes nor
  /// time.
  virtual void line_lost() { static_cast<void>(take_actions()); }
  /// The device sent these bytes, any number of them, cut anywhere.
  virtual void receive(std::span<const std::uint8_t> bytes, RobotTime now) = 0;
  /// Time has passed: timers are served.
  virtual void pass(RobotTime now) = 0;
  /// When pass() is wanted next.
  [[nodiscard]] virtual RobotTime wake() const = 0;
  /// Takes what is to be done to the line, in order.
  [[nodiscard]] virtual std::vector<LineAction> take_actions() = 0;
  /// The session ends in good order: take_actions() then has the device's farewell (motors off, stream stopped, the
  /// rate that the device had at first).
  virtual void close(RobotTime now) = 0;

  /// Whether the device answers as it should and sends values. The error says what is wrong, with the remedy; while
  /// the handshake goes on it is kNotReady and names the step.
  [[nodiscard]] virtual Status state() const = 0;
  /// The session cannot go on with this line: it is to be closed, and opened again after a while.
  [[nodiscard]] virtual bool wants_reopen() const = 0;
  [[nodiscard]] virtual LinkStatistics statistics() const = 0;
};

}  // namespace seeker::drivers
