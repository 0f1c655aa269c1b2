/// \file
/// Properties of a log found from its first records before it is read, because logs differ in more than their formats.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/core/pose2.hpp"
#include "server/drivers/replay/carmen_line.hpp"

namespace seeker::drivers {

struct LogTraits {
  /// Range that the scanner reports for a beam without return: the largest reading, where it occurs often and at
  /// several places.
  std::optional<double> reach_m;
  /// Scans without odometry stand beside others, because the recorder wrote each scan twice.
  bool raw_scans_repeat = false;
  bool scan_poses_stand = false;   ///< the scans' odometry never changes, but that of the odometry records does
  double odometry_period_s = 0.1;  ///< average time between odometry records
  double scan_period_s = 0.1;
  /// Assumed time from scan to scan, set where the stamps are too coarse to show when records were made.
  std::optional<double> invented_period_s;
  double records_per_scan = 1.0;  ///< odometry records and scans, divided by the number of scans
};

/// Examines records from the start of a log until it knows enough.
class LogSurvey {
 public:
  void add(const CarmenRecord& record);
  [[nodiscard]] bool knows_enough() const;
  [[nodiscard]] LogTraits traits() const;

 private:
  struct Motion {
    std::uint64_t records = 0;
    std::uint64_t changes = 0;  ///< changes of the stamp from one record to the next
    std::optional<Pose2> first;
    double first_s = 0.0;
    double last_s = 0.0;
    bool moved = false;

    void add(double stamp_s, const std::optional<Pose2>& pose);
    [[nodiscard]] double period_s() const;
  };
  void add_scan(const CarmenScan& scan);
  void watch_reach(double farthest_m);
  void watch_motion();
  /// Whether the stamps change so seldom that they show no more than that time passes.
  [[nodiscard]] bool stamps_are_coarse() const;
  [[nodiscard]] double plausible_period_s() const;

  Motion odometry_;
  Motion scans_;
  std::uint64_t raw_scans_ = 0;
  std::optional<Pose2> robot_;  ///< pose by the odometry records, or by the scans where there are none
  std::optional<Pose2> robot_at_scan_;
  /// For each scan: least time in which a robot of usual speed makes the recorded motion since the scan before.
  std::vector<double> least_s_;
  double farthest_m_ = 0.0;   ///< largest of all readings
  std::uint64_t as_far_ = 0;  ///< number of scans with this largest reading
  int places_ = 0;            ///< number of distinct places where it was read
  std::optional<Pose2> last_place_;
};

}  // namespace seeker::drivers
