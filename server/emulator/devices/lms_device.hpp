/// \file
/// An emulated SICK LMS200.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/core/rng.hpp"
#include "common/core/scan.hpp"
#include "server/emulator/devices/emulated_device.hpp"
#include "server/emulator/devices/lms_control.hpp"
#include "server/emulator/devices/lms_device_params.hpp"
#include "server/emulator/devices/lms_output.hpp"
#include "server/protocols/lms200/telegram_reader.hpp"

namespace seeker::emulator {

/// Acknowledges and answers the host's telegrams, and measures with a mirror of 75 rotations a second. A scan of K
/// rotations begins with each K-th rotation; its telegram begins when the last beam was measured, if the line is free
/// then. Otherwise the whole scan is left out, so that no scan waits and none is older than another.
class LmsDevice final : public EmulatedDevice {
 public:
  static constexpr double kMirrorPeriod_s = 1.0 / 75.0;

  /// The device has power for long and waits for commands at its power-on rate. `source` outlives it.
  LmsDevice(const LmsDeviceParams& params, LmsScanSource source);

  void receive(std::span<const std::uint8_t> bytes, RobotTime now) override;
  void pass(RobotTime now) override;
  [[nodiscard]] RobotTime wake() const override;
  [[nodiscard]] std::vector<std::uint8_t> take_output() override;
  [[nodiscard]] std::uint32_t baud() const override { return baud_; }
  void power_cycle(RobotTime now) override;

  void set_faults(const LmsFaults& faults) { control_.set_faults(faults); }
  [[nodiscard]] const LmsFaults& faults() const { return control_.faults(); }
  /// What the device keeps without power.
  [[nodiscard]] const lms200::ConfigBlock& flash() const { return control_.flash(); }

 private:
  /// A scan that will be sent.
  struct PlannedScan {
    RobotTime middle;
    RobotTime end;
    std::int64_t rotation = 0;  ///< of the mirror, the scan's last one
    std::optional<LaserScan> measured;
  };

  void take_commands(RobotTime now);
  void answer(std::span<const std::uint8_t> payload, RobotTime now);
  void acknowledge(std::uint8_t byte, RobotTime now);
  void send(std::span<const std::uint8_t> payload, RobotTime earliest);
  void serve_power(RobotTime now);
  void serve_scans(RobotTime now);
  void send_scan(const PlannedScan& scan);
  void restart(RobotTime at);
  [[nodiscard]] PlannedScan plan(RobotTime after) const;
  [[nodiscard]] bool off() const { return ready_at_.has_value(); }

  LmsDeviceParams params_;
  LmsScanSource source_;
  LmsControl control_;
  LmsOutput output_;
  lms200::TelegramReader reader_;
  Rng rng_;
  std::vector<std::uint8_t> taken_;  ///< by the owner with its next call
  std::uint32_t baud_;
  std::optional<std::uint32_t> new_baud_;
  RobotTime change_baud_at_;             ///< of new_baud_
  std::optional<RobotTime> restart_at_;  ///< after the reply to a reset
  std::optional<RobotTime> ready_at_;    ///< the device starts until then, and neither listens nor sends
  std::optional<PlannedScan> planned_;
  RobotTime last_byte_;
  std::uint64_t answered_damage_ = 0;  ///< damaged telegrams that were answered by NAK
  std::uint8_t telegrams_sent_ = 0;
};

}  // namespace seeker::emulator
