/// \file
/// Scans of the robot out of telegrams of the LMS200.
#pragma once

#include <optional>

#include "common/core/result.hpp"
#include "common/core/scan.hpp"
#include "common/core/time.hpp"
#include "server/drivers/lms200/lms_params.hpp"
#include "server/drivers/lms200/scan_clock.hpp"
#include "server/protocols/lms200/scan_telegram.hpp"

namespace seeker::drivers {

/// Makes scans with the angles and mount of the parameters, and with the time at which their middle beam was measured.
///
/// The mirror rotates 75 times a second, a scan takes one rotation for each fraction of a degree (protocols 2.7), and
/// the telegram begins when the last beam was measured. With K rotations of T and a field of view of a: the scan lasts
/// (K - 1) T + a T / 2 pi, and its middle is half of that before its end. The beams of all rotations lie between each
/// other, so that this is the mean time of the beams in the middle. A sub-range is off the middle by its angle.
class ScanMaker {
 public:
  static constexpr double kMirrorPeriod_s = 1.0 / 75.0;

  explicit ScanMaker(const LmsParams& params);

  /// The scan of a telegram whose first byte came whole at `first_byte`. kParse: it is not the scan that was asked for.
  [[nodiscard]] Result<LaserScan> make(const lms200::ScanTelegram& telegram, lms200::MeasuringMode mode,
                                       RobotTime first_byte);
  /// Time from the measurement of the middle beam to the arrival of the first byte, without delays.
  [[nodiscard]] Duration latency() const { return latency_; }
  /// The device starts again: its clock has another phase.
  void restart() { clock_.reset(); }

 private:
  [[nodiscard]] Status check(const lms200::ScanTelegram& telegram) const;

  LmsParams params_;
  ScanClock clock_;
  Duration latency_;
};

}  // namespace seeker::drivers
