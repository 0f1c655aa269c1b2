/// \file
/// What a SICK LMS200 is used for and how long its answers may take.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/core/pose2.hpp"
#include "common/core/result.hpp"
#include "server/protocols/lms200/commands.hpp"
#include "server/protocols/lms200/measuring.hpp"

namespace seeker::drivers {

struct LmsParams {
  /// Rate of the line while scans come, in bits per second; 500000 needs an RS-422 line.
  std::uint32_t baud = 38400;
  /// Other rates at which the device is looked for, after `baud`, in this order.
  std::vector<std::uint32_t> search_bauds{9600, 19200};
  lms200::Variant variant{180, 50};
  lms200::Unit unit = lms200::Unit::kMillimetre;
  lms200::MeasuringMode measuring_mode = lms200::MeasuringMode::k8mFieldsAbDazzle;
  /// Only these values of each scan are sent, so that more scans a second fit on the line. Nothing: all values.
  std::optional<lms200::SubRange> sub_range;
  /// Whether unit and measuring mode may be written to the device, which keeps them in flash that wears out. If not,
  /// it is used as it is, with a warning.
  bool may_write_flash = false;
  Pose2 base_T_laser;
  double range_min_m = 0.05;  ///< stated in the scans; no reading is removed

  double scan_timeout_s = 2.0;      ///< without a scan for so long the line is given up
  double reply_timeout_s = 1.0;     ///< on top of the time that the longest telegram needs on the line
  double mode_timeout_s = 3.0;      ///< likewise for changes of variant and mode, which restart the measurement
  double flash_timeout_s = 15.0;    ///< likewise for writing the configuration
  double baud_settle_s = 0.25;      ///< between the reply to a change of the rate and the first byte at the new one
  double retry_pause_s = 0.1;       ///< before a refused command is sent again
  double partial_timeout_s = 0.25;  ///< silence after which the rest of a telegram will not come
  int tries = 3;                    ///< of each command
  int search_tries = 2;             ///< of each rate in one round
  int rounds = 3;                   ///< over all rates, before the line is given up

  /// What the device needs between the end of a scan and its first byte on the line.
  double device_latency_s = 0.0;
  /// Whether bytes cannot come faster than the rate allows, as on a serial line or behind a converter. Then bytes that
  /// the operating system hands over late and together still show when they came.
  bool line_keeps_rate = true;
};

/// kInvalidArgument: a value the device does not have, or a time that is not positive or too short for the rate.
[[nodiscard]] Status validate(const LmsParams& params);
/// Number of values in each scan.
[[nodiscard]] std::size_t beams_of(const LmsParams& params);

}  // namespace seeker::drivers
