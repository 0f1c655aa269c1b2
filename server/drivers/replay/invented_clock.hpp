/// \file
/// Times for the records of a log without usable stamps, because the stamps were cut to a few digits or left out.
#pragma once

#include <optional>

#include "common/core/pose2.hpp"
#include "server/drivers/replay/carmen_line.hpp"

namespace seeker::drivers {

/// Assigns a time to each record, later than the previous one, with odometry and scans on one clock in the order in
/// which they were written. Records are a fixed time apart, and farther where the robot moved so far between them that
/// it would need longer, so that the resulting speeds are possible for a robot.
class InventedClock {
 public:
  /// `period_s`: time from one record to the next, above 0.
  explicit InventedClock(double period_s) : period_s_(period_s) {}

  /// The time of the next record in seconds after the first one.
  [[nodiscard]] double place(const CarmenRecord& record);

 private:
  double period_s_;
  std::optional<double> last_s_;
  std::optional<Pose2> odom_T_base_;  ///< pose of the newest odometry
};

}  // namespace seeker::drivers
