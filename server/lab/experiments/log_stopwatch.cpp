#include "server/lab/experiments/log_stopwatch.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numeric>
#include <utility>

namespace seeker::lab {
namespace {

double seconds_of(const timeval& time) {
  constexpr double kMicro = 1e-6;
  return static_cast<double>(time.tv_sec) + kMicro * static_cast<double>(time.tv_usec);
}

}  // namespace

TimeFigures time_figures(std::vector<double> times_s) {
  constexpr double kMilli = 1e3;
  constexpr double kTail = 0.99;
  if (times_s.empty()) {
    return {};
  }
  std::sort(times_s.begin(), times_s.end());
  const auto count = static_cast<double>(times_s.size());
  const auto at_ms = [&](double share) {
    const double rank = std::ceil(share * count) - 1.0;
    return kMilli * times_s[static_cast<std::size_t>(std::max(0.0, rank))];
  };
  return {kMilli * std::accumulate(times_s.begin(), times_s.end(), 0.0) / count, at_ms(0.5), at_ms(kTail),
          kMilli * times_s.back()};
}

void Stopwatch::start() {
  wall_start_ = std::chrono::steady_clock::now();
  processor_start_s_ = thread_seconds();
}

void Stopwatch::stop() {
  processor_sum_s_ += thread_seconds() - processor_start_s_;
  wall_sum_s_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_start_).count();
}

void Stopwatch::lap() {
  wall_s_.push_back(std::exchange(wall_sum_s_, 0.0));
  processor_s_.push_back(std::exchange(processor_sum_s_, 0.0));
}

double thread_seconds() {
  timespec time{};
  constexpr double kNano = 1e-9;
  return clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time) == 0
             ? static_cast<double>(time.tv_sec) + kNano * static_cast<double>(time.tv_nsec)
             : 0.0;
}

double process_seconds() {
  rusage usage{};
  return getrusage(RUSAGE_SELF, &usage) == 0 ? seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime) : 0.0;
}

double peak_memory_mb() {
  rusage usage{};
  constexpr double kKilobytesPerMegabyte = 1024.0;
  return getrusage(RUSAGE_SELF, &usage) == 0 ? static_cast<double>(usage.ru_maxrss) / kKilobytesPerMegabyte : 0.0;
}

}  // namespace seeker::lab
