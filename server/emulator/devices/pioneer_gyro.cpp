#include "server/emulator/devices/pioneer_gyro.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace seeker::emulator {
namespace {

constexpr std::uint8_t kTemperature = 25;

}  // namespace

void PioneerGyro::start(RobotTime now) {
  next_ = now + p2os::kGyroReadingPeriod;
  readings_.clear();
}

void PioneerGyro::follow(double omega_rad_s, RobotTime now) {
  for (; next_ <= now && readings_.size() < p2os::kMaxGyroReadings; next_ += p2os::kGyroReadingPeriod) {
    const double count = rest_count_ - omega_rad_s / rad_s_per_count_ + carried_;
    const double shown = std::clamp(std::round(count), 0.0, static_cast<double>(p2os::kGyroMaxCount));
    carried_ = std::clamp(count - shown, -0.5, 0.5);
    readings_.push_back({static_cast<std::uint16_t>(shown), kTemperature});
  }
  next_ = std::max(next_, now);
}

std::vector<p2os::GyroReading> PioneerGyro::take() { return std::exchange(readings_, {}); }

}  // namespace seeker::emulator
