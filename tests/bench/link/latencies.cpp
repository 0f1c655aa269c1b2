#include "tests/bench/link/latencies.hpp"

#include <chrono>
#include <fstream>

namespace seeker::link_bench {

RobotTime now() { return RobotTime(std::chrono::steady_clock::now().time_since_epoch()); }

void Latencies::add(Duration latency) {
  const std::lock_guard lock(mutex_);
  all_.push_back(latency);
}

Status Latencies::write(const std::filesystem::path& file) const {
  const std::lock_guard lock(mutex_);
  std::ofstream out(file);
  for (const Duration latency : all_) {
    out << std::chrono::duration<double, std::micro>(latency).count() << '\n';
  }
  out.flush();
  return out ? Status() : Status(fail(Errc::kIo, file.string() + " cannot be written"));
}

}  // namespace seeker::link_bench
