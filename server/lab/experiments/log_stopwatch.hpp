/// \file
/// Cost of a scan: wall time, and processor time of the thread, which does not depend on other load of the machine.
#pragma once

#include <chrono>
#include <vector>

namespace seeker::lab {

/// Times of all scans of a log, in ms.
struct TimeFigures {
  double mean_ms = 0.0;
  double median_ms = 0.0;
  double p99_ms = 0.0;
  double max_ms = 0.0;
};

/// Figures of a list; zeros for an empty one. Quantiles are entries of the list (the smallest entry with at least that
/// share of the list at or below it).
[[nodiscard]] TimeFigures time_figures(std::vector<double> times_s);

/// Adds up the time between start() and stop().
class Stopwatch {
 public:
  void start();
  void stop();
  /// Ends a scan: its times are added to the lists, and the next scan begins at zero.
  void lap();

  [[nodiscard]] TimeFigures wall() const { return time_figures(wall_s_); }
  [[nodiscard]] TimeFigures processor() const { return time_figures(processor_s_); }

 private:
  std::chrono::steady_clock::time_point wall_start_;
  double processor_start_s_ = 0.0;
  double wall_sum_s_ = 0.0;
  double processor_sum_s_ = 0.0;
  std::vector<double> wall_s_;
  std::vector<double> processor_s_;
};

/// Processor time of this thread so far, s.
[[nodiscard]] double thread_seconds();
/// Processor time of the whole process so far, s.
[[nodiscard]] double process_seconds();
/// Peak memory of this process so far, in MB.
[[nodiscard]] double peak_memory_mb();

}  // namespace seeker::lab
