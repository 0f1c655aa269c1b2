/// \file
/// What a log's own records tell of the log, before it is read: logs differ in more than their formats.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/core/pose2.hpp"
#include "server/drivers/replay/carmen_line.hpp"

namespace seeker::drivers {

struct LogTraits {
  /// What the scanner reports where nothing comes back: the farthest reading, where it is often the same and from
  /// several places.
  std::optional<double> reach_m;
  bool raw_scans_repeat = false;   ///< scans without odometry stand beside others: the recorder wrote each scan twice
  bool scan_poses_stand = false;   ///< the scans' odometry never moves, that of the odometry records does
  double odometry_period_s = 0.1;  ///< on average
  double scan_period_s = 0.1;
  /// Set where the stamps are too coarse to tell when anything was recorded: what a scan is taken to last.
  std::optional<double> invented_period_s;
  double records_per_scan = 1.0;  ///< odometry records and scans, for each scan
};

/// Looks at records from the start of a log until it knows enough.
class LogSurvey {
 public:
  void add(const CarmenRecord& record);
  [[nodiscard]] bool knows_enough() const;
  [[nodiscard]] LogTraits traits() const;

 private:
  struct Motion {
    std::uint64_t records = 0;
    std::uint64_t changes = 0;  ///< of the stamp, from one record to the next
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
  /// The stamps change so seldom that they tell no more than that time passes.
  [[nodiscard]] bool stamps_are_coarse() const;
  [[nodiscard]] double plausible_period_s() const;

  Motion odometry_;
  Motion scans_;
  std::uint64_t raw_scans_ = 0;
  std::optional<Pose2> robot_;  ///< by the odometry records, or by the scans where there are none
  std::optional<Pose2> robot_at_scan_;
  std::vector<double> least_s_;  ///< from scan to scan: what a robot of usual speed needs for the recorded motion
  double farthest_m_ = 0.0;      ///< of all readings
  std::uint64_t as_far_ = 0;     ///< scans whose farthest reading it is
  int places_ = 0;               ///< apart from each other, from where it was read
  std::optional<Pose2> last_place_;
};

}  // namespace seeker::drivers
