/// \file
/// The device's clock, read off the arrivals of its telegrams.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

#include "common/core/time.hpp"

namespace seeker::drivers {

struct ScanClockParams {
  double period_s = 1.0 / 75.0;  ///< nominal time of one scan; telegrams are whole numbers of scans apart
  double tolerance = 0.01;       ///< largest relative error of that time, of motor and clocks together
  std::size_t window = 128;      ///< arrivals that are used
  std::size_t free_slope = 48;   ///< arrivals from which on the slope is free within the whole tolerance
  std::size_t learning = 8;      ///< arrivals until the distance of telegrams is known
};

/// Removes the jitter from arrivals. Telegram i leaves at t0 + n_i P, where P is the time of a scan, constant but known
/// only within a tolerance, and n_i whole numbers; it arrives d_i >= 0 later. So the arrivals lie over a line in n, and
/// the ones that were not delayed on it. Of all lines below the arrivals the one nearest to them is used (smallest sum
/// of the distances, a linear programme: it is the edge of their lower convex hull at their mean n). It needs neither
/// the distribution of the delays nor their bound; a constant part of the delay cannot be seen.
///
/// The line from the device is as a rule slower than the device, which then sends every k-th scan. k is found from the
/// first distances, because a delay may be longer than P and n would be ambiguous: the number of which most distances
/// are nearly a multiple, and of several such the largest. Until then arrivals are returned as they are. If all newest
/// arrivals lie over half a scan above the line, or one lies clearly below it, the device has changed its phase, and
/// that begins again.
class ScanClock {
 public:
  explicit ScanClock(const ScanClockParams& params) : params_(params) {}

  /// The arrival without its delay, given in the order of the telegrams: never later than `arrival`.
  [[nodiscard]] RobotTime place(RobotTime arrival);
  /// Whether the distance of the telegrams is known, so that delays are removed.
  [[nodiscard]] bool distance_known() const { return scans_apart_ > 0; }
  void reset();

 private:
  struct Point {
    double device_s = 0.0;  ///< n P, from the first point on
    double arrival_s = 0.0;
  };
  struct Line {
    double at_zero_s = 0.0;
    double slope = 1.0;

    [[nodiscard]] double at(double device_s) const { return at_zero_s + slope * device_s; }
  };

  void learn();
  /// Numbers the scans of the points, whose telegrams are whole multiples of this time apart.
  void number_points(double step_s);
  void begin_with(RobotTime arrival);
  [[nodiscard]] double next_device_s(double arrival_s) const;
  [[nodiscard]] bool phase_changed() const;
  [[nodiscard]] Line lower_line() const;
  [[nodiscard]] double hull_slope(double mean_device_s) const;

  ScanClockParams params_;
  RobotTime origin_;  ///< arrival of the first point
  std::deque<Point> points_;
  std::int64_t scans_apart_ = 0;  ///< k; 0 while it is not known
  Line line_;
};

}  // namespace seeker::drivers
