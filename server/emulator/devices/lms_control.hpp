/// \file
/// What an emulated LMS200 answers, without its line and its measurements.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "server/emulator/devices/lms_device_params.hpp"
#include "server/protocols/lms200/commands.hpp"
#include "server/protocols/lms200/responses.hpp"
#include "server/protocols/lms200/telegram.hpp"

namespace seeker::emulator {

/// What follows from a command.
struct LmsAnswer {
  std::vector<std::uint8_t> payload;      ///< of the reply; empty: the reply is a scan
  std::optional<std::uint32_t> new_baud;  ///< the rate after the reply
  bool restarts = false;                  ///< after the reply
  double delay_s = 0.0;                   ///< before the reply
};

/// Operating mode, variant and configuration, and the commands that read and change them (protocols 2.3). Commands that
/// are unknown or not allowed in the mode are answered by 0x92.
class LmsControl {
 public:
  explicit LmsControl(const LmsDeviceParams& params);

  [[nodiscard]] LmsAnswer answer(std::span<const std::uint8_t> payload);
  /// Everything but the flash is as after power on.
  void restart();

  /// Whether all scans are sent, or the values of sub_range() of them.
  [[nodiscard]] bool continuous() const;
  [[nodiscard]] std::optional<lms200::SubRange> sub_range() const;
  /// One scan was asked for and is not sent yet.
  [[nodiscard]] bool scan_requested() const { return scan_requested_; }
  void scan_sent() { scan_requested_ = false; }
  [[nodiscard]] const lms200::Variant& variant() const { return variant_; }
  [[nodiscard]] const lms200::ConfigBlock& flash() const { return flash_; }
  [[nodiscard]] std::uint8_t mode() const { return mode_; }
  [[nodiscard]] lms200::StatusByte status() const;
  void set_faults(const LmsFaults& faults) { faults_ = faults; }
  [[nodiscard]] const LmsFaults& faults() const { return faults_; }
  void set_baud(std::uint32_t baud) { baud_ = baud; }

 private:
  [[nodiscard]] LmsAnswer on(const lms200::Reset& command);
  [[nodiscard]] LmsAnswer on(const lms200::SetMode& command);
  [[nodiscard]] LmsAnswer on(const lms200::RequestValues& command);
  [[nodiscard]] LmsAnswer on(const lms200::RequestStatus& command);
  [[nodiscard]] LmsAnswer on(const lms200::RequestErrors& command);
  [[nodiscard]] LmsAnswer on(const lms200::RequestType& command);
  [[nodiscard]] LmsAnswer on(const lms200::SetVariant& command);
  [[nodiscard]] LmsAnswer on(const lms200::RequestConfig& command);
  [[nodiscard]] LmsAnswer on(const lms200::SetConfig& command);
  [[nodiscard]] LmsAnswer not_accepted() const;
  [[nodiscard]] lms200::ModeResult change_mode(const lms200::SetMode& command);

  LmsDeviceParams params_;
  LmsFaults faults_;
  lms200::ConfigBlock flash_;
  lms200::Variant variant_;
  std::uint8_t mode_ = lms200::operating_mode::kRequest;
  lms200::SubRange sub_range_;
  bool scan_requested_ = false;
  std::uint32_t baud_ = lms200::kPowerOnBaud;
};

}  // namespace seeker::emulator
