/// \file
/// What an emulated LMS200 is like, and its faults.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "common/core/scan.hpp"
#include "common/core/time.hpp"
#include "server/protocols/lms200/baud_rate.hpp"
#include "server/protocols/lms200/config_block.hpp"
#include "server/protocols/lms200/measuring.hpp"

namespace seeker::emulator {

/// The scan of the world at this time, over at least the field of view of the variant, with constant steps. It is asked
/// for when the middle of a scan passes.
using LmsScanSource = std::function<LaserScan(RobotTime now)>;

struct LmsDeviceParams {
  /// Programs look for "LMS200;30106" in it.
  std::string type = "LMS200;30106;V02.30";
  std::string software_version = "V02.30 ";  ///< 7 characters
  std::string prom_version = "X01.20 ";      ///< likewise
  std::uint32_t power_on_baud = lms200::kPowerOnBaud;
  lms200::Variant variant{180, 100};  ///< after power on
  lms200::ConfigBlock flash;          ///< configuration that outlives a power cycle
  bool sends_telegram_index = false;  ///< a byte behind the values, as some devices do
  double start_up_s = 2.0;            ///< from power on to the telegram that says so
  double flash_write_s = 0.5;         ///< before the reply to a new configuration
  double partial_timeout_s = 0.1;     ///< silence of the host after which the rest of a telegram is not waited for
  std::uint64_t seed = 1;             ///< of the faults
};

/// Faults of the device, switched on and off while it works.
struct LmsFaults {
  bool polluted = false;   ///< the front window is dirty
  bool fatal = false;      ///< a fatal error, reported in status bytes and in the error list
  double wrong_crc = 0.0;  ///< part of the telegrams that carry a wrong checksum

  friend bool operator==(const LmsFaults&, const LmsFaults&) = default;
};

}  // namespace seeker::emulator
