/// \file
/// What the robot loop asks of a device. Hardware, simulator and replay implement the same; the loop cannot tell.
/// All calls come from the loop's thread and return at once: a driver with a slow device reads it on its own thread
/// and hands over the newest sample.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/core/image.hpp"
#include "common/core/pose2.hpp"
#include "common/core/result.hpp"
#include "common/core/scan.hpp"
#include "common/core/stereo.hpp"
#include "common/core/tick_timing.hpp"
#include "common/core/time.hpp"

namespace seeker::drivers {

/// Common lifecycle of every device.
class Driver {
 public:
  Driver() = default;
  Driver(const Driver&) = delete;
  Driver& operator=(const Driver&) = delete;
  virtual ~Driver() = default;

  /// Opens the device. Called again after a fault to restart it.
  [[nodiscard]] virtual Status activate() = 0;
  /// Closes the device; the base halts first.
  virtual void deactivate() = 0;
};

/// What the base measured about itself.
struct OdometrySample {
  RobotTime stamp;
  Pose2 odom_T_base;  ///< dead reckoning since activation
  Twist2 velocity;
  std::optional<double> battery_v;
  bool motors_enabled = false;
  bool stalled = false;  ///< a wheel is blocked
  bool bumped = false;   ///< a bumper is pressed

  friend bool operator==(const OdometrySample&, const OdometrySample&) = default;
};

/// A differential-drive base.
class BaseDriver : public Driver {
 public:
  /// The newest sample since the last call; nothing when there is none.
  [[nodiscard]] virtual Result<std::optional<OdometrySample>> read() = 0;
  /// Holds the velocity until the next call or until the driver's own time-out has passed, then halts.
  [[nodiscard]] virtual Status set_velocity(const Twist2& velocity, RobotTime now) = 0;
  [[nodiscard]] virtual Status set_motors(bool enabled) = 0;
  /// Whether it moves as it is told. kRefused says why it never does: a recording goes its own way.
  [[nodiscard]] virtual Status drivable() const { return {}; }
};

class LidarDriver : public Driver {
 public:
  /// The newest sweep since the last call; nothing when there is none.
  [[nodiscard]] virtual Result<std::optional<LaserScan>> read() = 0;
};

class SonarDriver : public Driver {
 public:
  [[nodiscard]] virtual Result<std::optional<SonarScan>> read() = 0;
};

class CameraDriver : public Driver {
 public:
  /// Exposes and returns one picture. In lockstep it is rendered here, inline.
  [[nodiscard]] virtual Result<CameraFrame> grab() = 0;
};

class StereoDriver : public Driver {
 public:
  /// Exposes both eyes at one moment and returns the rectified pictures.
  [[nodiscard]] virtual Result<StereoFrame> grab() = 0;
  /// Of the pictures that grab() returns.
  [[nodiscard]] virtual const StereoGeometry& geometry() const = 0;
};

/// What makes robot time advance.
class Clock {
 public:
  Clock() = default;
  Clock(const Clock&) = delete;
  Clock& operator=(const Clock&) = delete;
  virtual ~Clock() = default;

  [[nodiscard]] virtual RobotTime now() const = 0;
  /// Lockstep: the world advances by `period` and the call returns at once (or paces itself to the chosen speed).
  /// Live: sleeps until the next tick. kCancelled: the source has ended (a replay's last record).
  [[nodiscard]] virtual Status advance(Duration period) = 0;
  /// Waits at most `limit` of wall time for where advance() leads to, so that its caller can do other things meanwhile.
  /// False: not there yet. Clocks whose advance() itself waits are always there. kCancelled as above.
  [[nodiscard]] virtual Result<bool> await(Duration /*limit*/) { return true; }
  /// Whether the world that the devices are in is there; the error says why not, and the time stands still meanwhile.
  /// kCancelled: it never comes back. Only a world behind a link can be lost.
  [[nodiscard]] virtual Status reachable() const { return {}; }
  /// True where the world stands still unless advance() is called.
  [[nodiscard]] virtual bool lockstep() const = 0;
  /// Where several robots share a world: it stands still from here until advance() or let_go(). Devices are read and
  /// commanded in between only.
  virtual void hold() {}
  /// This robot does not tick for now: the others' world goes on without it.
  virtual void let_go() {}
  /// Robot seconds per wall second; 0: as fast as possible.
  [[nodiscard]] virtual double speed() const = 0;
  /// How well the ticks keep to the wall clock; nothing at speed 0, or where another process paces them.
  [[nodiscard]] virtual std::optional<TickTiming> timing() const { return std::nullopt; }
};

}  // namespace seeker::drivers
