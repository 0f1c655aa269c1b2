/// \file
/// Times for the records of a log whose stamps do not tell any: stamps that were cut to a few digits, or left out.
#pragma once

#include <optional>

#include "common/core/pose2.hpp"
#include "server/drivers/replay/carmen_line.hpp"

namespace seeker::drivers {

/// Gives each record a time after that of the one before, odometry and scans on one clock, in the order in which they
/// were written. Records are a fixed time apart, and farther where the robot moved so far between them that wheels
/// would need longer: no speed that comes of these times is one that a robot cannot have.
class InventedClock {
 public:
  /// `period_s`: from one record to the next, above 0.
  explicit InventedClock(double period_s) : period_s_(period_s) {}

  /// The time of the next record, s from the first one, which is at 0.
  [[nodiscard]] double place(const CarmenRecord& record);

 private:
  double period_s_;
  std::optional<double> last_s_;
  std::optional<Pose2> odom_T_base_;  ///< the newest odometry
};

}  // namespace seeker::drivers
