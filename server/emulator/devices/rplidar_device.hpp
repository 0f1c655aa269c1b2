/// \file
/// An RPLIDAR A1 or A2 as a state machine (protocols 3).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "server/emulator/devices/emulated_device.hpp"
#include "server/emulator/devices/rotor.hpp"
#include "server/protocols/rplidar/device_answers.hpp"
#include "server/protocols/rplidar/express_capsule.hpp"
#include "server/protocols/rplidar/request.hpp"
#include "server/protocols/rplidar/request_reader.hpp"

namespace seeker::emulator {

struct RplidarDeviceParams {
  rplidar::DeviceInfo info;
  bool accessory_board = false;  ///< the motor is driven by request; without one it always turns
  double rotation_hz = 5.5;      ///< at full speed, with a board at `full_pwm`
  std::uint16_t full_pwm = 660;
  Duration legacy_period = std::chrono::microseconds(500);   ///< from sample to sample of SCAN
  Duration express_period = std::chrono::microseconds(250);  ///< and of EXPRESS_SCAN
  double range_max_m = 12.0;                                 ///< what is farther gives no echo
  /// The beam passes the axis at this distance, so that near objects appear at another angle than the rotor's.
  double beam_offset_m = 0.010;
  double least_rotation_hz = 1.0;                       ///< below it SCAN and EXPRESS_SCAN send nothing
  std::uint8_t quality = 47;                            ///< of an echo, at most 63
  Duration boot_time = std::chrono::milliseconds(600);  ///< deaf after power on and RESET; then it prints a banner
  Duration request_timeout = std::chrono::milliseconds(100);  ///< for the rest of a request that has begun
  Duration stuck_time = std::chrono::milliseconds(1500);      ///< a driven rotor that stands so long: protection stop
  RotorParams rotor;
};

/// A1M8 with firmware 1.20: 5.5 Hz, always turning.
[[nodiscard]] RplidarDeviceParams rplidar_a1();
/// A2M8 with firmware 1.29 on its accessory board: 10 Hz, turning on request.
[[nodiscard]] RplidarDeviceParams rplidar_a2();

/// What the device would measure at a moment: the distance in metres in a direction, counter-clockwise from its front
/// mark, (-pi, pi]. Nothing: no echo. Noise is the hook's matter. It is called with rising times, none later than that
/// of the call in which it happens.
using RangeInDirection = std::function<std::optional<double>(double bearing_rad, RobotTime at)>;

class RplidarDevice final : public EmulatedDevice {
 public:
  /// The device has power, is idle, and an A1 turns at full speed.
  RplidarDevice(const RplidarDeviceParams& params, RangeInDirection measure);

  void receive(std::span<const std::uint8_t> bytes, RobotTime now) override;
  void pass(RobotTime now) override;
  [[nodiscard]] RobotTime wake() const override;
  [[nodiscard]] std::vector<std::uint8_t> take_output() override;
  [[nodiscard]] std::uint32_t baud() const override;
  void power_cycle(RobotTime now) override;

  /// A fault: the device measures no more until it is reset.
  void stop_for_protection(std::uint16_t code);
  /// A warning in its health until power is cut; it measures all the same.
  void warn(std::uint16_t code);
  /// A hand holds the rotor, until it lets it go.
  void block_rotor(bool blocked);

  [[nodiscard]] bool scanning() const { return stream_ != Stream::kNone; }
  /// Turns per second of its rotor.
  [[nodiscard]] double rotation_hz() const { return rotor_.rate_hz(); }

 private:
  enum class Stream : std::uint8_t { kNone, kLegacy, kExpress };
  /// One measurement with the angle of the rotor.
  struct Measured {
    std::uint16_t raw_angle_q6 = 0;
    std::uint8_t compensation_q3 = 0;
    std::optional<double> range_m;
  };

  void boot(RobotTime now);
  void wake_up();
  void handle(const rplidar::Request& request, RobotTime now);
  void answer_conf(const rplidar::Request& request);
  void start(Stream stream, bool forced, RobotTime now);
  void end_scan();
  void advance(RobotTime now);
  void advance_rotor(Duration passed);
  void take_sample();
  [[nodiscard]] Measured measure() const;
  void send_legacy(const Measured& measured);
  void gather(const Measured& measured);
  void send(std::span<const std::uint8_t> bytes);
  [[nodiscard]] double target_hz() const;
  [[nodiscard]] Duration sample_period() const;

  RplidarDeviceParams params_;
  RangeInDirection measure_;
  rplidar::RequestReader requests_;
  RobotTime last_byte_;
  Rotor rotor_;
  bool blocked_ = false;
  Duration stuck_for_{};
  std::uint16_t pwm_ = 0;
  rplidar::Health health_;
  std::optional<RobotTime> booted_at_;  ///< while it boots: when it is done
  std::optional<RobotTime> time_;       ///< up to which it has turned and measured; none before the first call
  Stream stream_ = Stream::kNone;
  bool forced_ = false;                       ///< sends whether it turns or not
  std::optional<std::uint16_t> last_raw_q6_;  ///< of the sample sent before
  rplidar::ExpressCapsule capsule_;
  std::size_t gathered_ = 0;  ///< samples in capsule_
  std::vector<std::uint8_t> output_;
};

}  // namespace seeker::emulator
