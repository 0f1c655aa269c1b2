#include "server/drivers/rplidar/scan_stream.hpp"

#include <utility>
#include <variant>

namespace seeker::drivers {

void ScanStream::start(Duration sample_period, Duration byte_time) {
  revolutions_.restart();
  chain_.reset();
  sample_period_ = sample_period;
  byte_time_ = byte_time;
}

std::optional<LaserScan> ScanStream::add(const rplidar::Answer& answer, RobotTime now) {
  const auto begun_before = [&](std::size_t bytes) {
    return now - byte_time_ * static_cast<Duration::rep>(answer.bytes_behind + bytes);
  };
  if (const auto* sample = std::get_if<rplidar::LegacySample>(&answer.value)) {
    return revolutions_.add(rplidar::to_polar(*sample), begun_before(rplidar::kLegacyBytes));
  }
  if (const auto* capsule = std::get_if<rplidar::ExpressCapsule>(&answer.value)) {
    return add_capsule(*capsule, answer.after_gap, begun_before(rplidar::kCapsuleBytes));
  }
  return std::nullopt;
}

std::optional<LaserScan> ScanStream::add_capsule(const rplidar::ExpressCapsule& capsule, bool after_gap,
                                                 RobotTime measured) {
  const RobotTime last_measured = std::exchange(held_measured_, measured);
  const auto samples = chain_.add(capsule, after_gap);
  if (!samples) {
    return std::nullopt;
  }
  std::optional<LaserScan> turn;
  RobotTime time = last_measured - sample_period_ * static_cast<Duration::rep>(rplidar::kCapsuleSamples - 1);
  for (const rplidar::PolarSample& sample : *samples) {
    if (std::optional<LaserScan> whole = revolutions_.add(sample, time)) {
      turn = std::move(whole);
    }
    time += sample_period_;
  }
  return turn;
}

}  // namespace seeker::drivers
