/// \file
/// Interfaces of the devices that the robot loop uses. Hardware, simulator and replay implement the same ones, so that
/// the loop is independent of them. All calls come from the loop's thread and return at once: a driver with a slow
/// device reads it on its own thread and returns the newest sample.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/core/image.hpp"
#include "common/core/pose2.hpp"
#include "common/core/result.hpp"
#include "common/core/scan.hpp"
#include "common/core/stereo.hpp"
#include "common/core/tick_timing.hpp"
#include "common/core/time.hpp"
#include "server/drivers/interfaces/link_statistics.hpp"

namespace seeker::drivers {

/// Something that is wrong with a device while it lasts: its line is broken, a bumper is pressed, its window is dirty.
struct DeviceFault {
  std::string id;  ///< short and stable, such as "lost" or "bumper"
  std::string message;
  std::string remedy;
  /// True: the robot can do nothing while it lasts. False: it goes on, and its user sees a warning.
  bool blocking = true;

  friend bool operator==(const DeviceFault&, const DeviceFault&) = default;
};

/// Common lifecycle of every device.
class Driver {
 public:
  Driver() = default;
  Driver(const Driver&) = delete;
  Driver& operator=(const Driver&) = delete;
  virtual ~Driver() = default;

  /// Opens the device. It is called again after a fault to restart the device.
  [[nodiscard]] virtual Status activate() = 0;
  /// Closes the device; the base halts first.
  virtual void deactivate() = 0;
  /// Delivers samples at another period, above 0, from now on. kRefused: the period of this device is fixed.
  [[nodiscard]] virtual Status set_period(Duration /*period*/) {
    return fail(Errc::kRefused, "this driver delivers at the pace of its device, which it cannot change");
  }
  /// Everything that is wrong with the device now; empty when it works.
  [[nodiscard]] virtual std::vector<DeviceFault> faults() const { return {}; }
  /// What has gone over the device's line. Nothing: it has none.
  [[nodiscard]] virtual std::optional<LinkStatistics> statistics() const { return std::nullopt; }
};

/// The state that the base measured.
struct OdometrySample {
  RobotTime stamp;
  Pose2 odom_T_base;  ///< dead reckoning since activation
  Twist2 velocity;
  std::optional<double> battery_v;
  bool motors_enabled = false;
  bool stalled = false;  ///< a wheel is blocked
  bool bumped = false;   ///< a bumper is pressed
  /// The base may have moved unseen since the sample before, as when its line was cut: how the pose goes on from there
  /// is a guess, as near to every place where the base can be as the driver knows.
  bool discontinued = false;

  friend bool operator==(const OdometrySample&, const OdometrySample&) = default;
};

/// A differential-drive base.
class BaseDriver : public Driver {
 public:
  /// The newest sample since the last call. Nothing: there is none.
  [[nodiscard]] virtual Result<std::optional<OdometrySample>> read() = 0;
  /// Holds the velocity until the next call or until the driver's own time-out, and then halts.
  [[nodiscard]] virtual Status set_velocity(const Twist2& velocity, RobotTime now) = 0;
  [[nodiscard]] virtual Status set_motors(bool enabled) = 0;
  /// Whether the base moves as commanded. kRefused gives the reason why it never does: a recording follows its own
  /// path.
  [[nodiscard]] virtual Status drivable() const { return {}; }
};

class LidarDriver : public Driver {
 public:
  /// The newest sweep since the last call. Nothing: there is none.
  [[nodiscard]] virtual Result<std::optional<LaserScan>> read() = 0;
};

class SonarDriver : public Driver {
 public:
  [[nodiscard]] virtual Result<std::optional<SonarScan>> read() = 0;
};

class CameraDriver : public Driver {
 public:
  /// Exposes and returns one picture. In lockstep it is rendered in this call.
  [[nodiscard]] virtual Result<CameraFrame> grab() = 0;
};

class StereoDriver : public Driver {
 public:
  /// Exposes both eyes at one moment and returns the rectified pictures.
  [[nodiscard]] virtual Result<StereoFrame> grab() = 0;
  /// Geometry of the pictures that grab() returns.
  [[nodiscard]] virtual const StereoGeometry& geometry() const = 0;
};

/// The source of robot time.
class Clock {
 public:
  Clock() = default;
  Clock(const Clock&) = delete;
  Clock& operator=(const Clock&) = delete;
  virtual ~Clock() = default;

  [[nodiscard]] virtual RobotTime now() const = 0;
  /// Ends a tick; await() says when the next one, `period` of robot time later, may begin. Lockstep: the world has
  /// advanced when this returns. kCancelled: the source has ended (a replay's last record).
  [[nodiscard]] virtual Status advance(Duration period) = 0;
  /// Waits at most `limit` of wall time for the next tick, so that its caller can do other work meanwhile. False: it is
  /// not reached yet. Clocks as fast as possible always return true. kCancelled as above.
  [[nodiscard]] virtual Result<bool> await(Duration /*limit*/) { return true; }
  /// Whether the world of the devices can be reached. The error gives the reason, and the time stands still meanwhile.
  /// kCancelled: it will never return. Only a world behind a link can be lost.
  [[nodiscard]] virtual Status reachable() const { return {}; }
  /// True where the world advances in advance() only.
  [[nodiscard]] virtual bool lockstep() const = 0;
  /// For several robots in a shared world: the world stands still from here until advance() or let_go(). Devices are
  /// read and commanded in between only.
  virtual void hold() {}
  /// This robot does not tick for now: the world of the others continues without it.
  virtual void let_go() {}
  /// Robot seconds per wall second; 0: as fast as possible.
  [[nodiscard]] virtual double speed() const = 0;
  /// Accuracy of the ticks relative to the wall clock. Nothing: the speed is 0, or another process paces them.
  [[nodiscard]] virtual std::optional<TickTiming> timing() const { return std::nullopt; }
};

}  // namespace seeker::drivers
