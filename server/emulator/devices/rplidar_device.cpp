#include "server/emulator/devices/rplidar_device.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "common/core/angle.hpp"
#include "common/core/assert.hpp"
#include "server/protocols/rplidar/legacy_sample.hpp"

namespace seeker::emulator {
namespace {

constexpr std::uint32_t kBaud = 115'200;
constexpr RobotTime kNever = RobotTime::max();
/// What an owner that is late may have measured at once; the rest of the time passes unmeasured.
constexpr Duration kMaxCatchUp = std::chrono::seconds(1);
/// Of an owner that does not take its output the newest bytes are dropped.
constexpr std::size_t kMaxOutput = 65'536;
/// Samples that are sent one by one may wait for so many of their kind.
constexpr int kLegacyBatch = 8;
constexpr std::uint16_t kStuckCode = 0x8001;
constexpr double kQ6PerRevolution = rplidar::kRevolutionQ6;
constexpr double kQ3PerRad = 8.0 * 180.0 / kPi;
/// Half of what the field holds, below the bit that some programs take for a sign.
constexpr double kMaxCompensationQ3 = 31.0;
constexpr double kQ2PerMetre = 4000.0;
constexpr std::array<std::uint8_t, 16> kSerial{0x9A, 0x6B, 0x99, 0xF0, 0xC3, 0xE2, 0x9A, 0xC2,
                                               0xA0, 0xE0, 0x98, 0xF5, 0x42, 0x17, 0x4A, 0x05};

}  // namespace

RplidarDeviceParams rplidar_a1() {
  RplidarDeviceParams params;
  params.info = {0x18, {1, 20}, 5, kSerial};
  return params;
}

RplidarDeviceParams rplidar_a2() {
  RplidarDeviceParams params;
  params.info = {0x28, {1, 29}, 6, kSerial};
  params.accessory_board = true;
  params.rotation_hz = 10.0;
  return params;
}

RplidarDevice::RplidarDevice(const RplidarDeviceParams& params, RangeInDirection measure)
    : params_(params), measure_(std::move(measure)), rotor_(params.rotor) {
  SEEKER_ASSERT(measure_ && params_.legacy_period > Duration::zero() && params_.express_period > Duration::zero());
  SEEKER_ASSERT(params_.quality <= rplidar::kMaxLegacyQuality);
  rotor_.advance(kMaxCatchUp * 10, target_hz());
}

std::uint32_t RplidarDevice::baud() const { return kBaud; }

std::vector<std::uint8_t> RplidarDevice::take_output() { return std::exchange(output_, {}); }

void RplidarDevice::send(std::span<const std::uint8_t> bytes) {
  if (output_.size() + bytes.size() <= kMaxOutput) {
    output_.insert(output_.end(), bytes.begin(), bytes.end());
  }
}

void RplidarDevice::receive(std::span<const std::uint8_t> bytes, RobotTime now) {
  pass(now);
  if (booted_at_) {
    return;
  }
  last_byte_ = now;
  for (const rplidar::Request& request : requests_.read(bytes)) {
    handle(request, now);
  }
}

void RplidarDevice::pass(RobotTime now) {
  advance(now);
  if (booted_at_ && now >= *booted_at_) {
    wake_up();
  }
  if (!booted_at_ && requests_.waits() && now >= last_byte_ + params_.request_timeout) {
    for (const rplidar::Request& request : requests_.give_up()) {
      handle(request, now);
    }
  }
}

RobotTime RplidarDevice::wake() const {
  if (booted_at_) {
    return *booted_at_;
  }
  RobotTime next = requests_.waits() ? last_byte_ + params_.request_timeout : kNever;
  if (time_ && scanning()) {
    const auto samples =
        stream_ == Stream::kExpress ? static_cast<int>(rplidar::kCapsuleSamples - gathered_) : kLegacyBatch;
    next = std::min(next, *time_ + sample_period() * samples);
  }
  return next;
}

void RplidarDevice::power_cycle(RobotTime now) {
  advance(now);
  pwm_ = 0;
  health_ = {};
  boot(now);
}

void RplidarDevice::boot(RobotTime now) {
  end_scan();
  if (health_.status == rplidar::HealthStatus::kProtectionStop) {
    health_ = {};
  }
  stuck_for_ = {};
  requests_.clear();
  output_.clear();
  booted_at_ = now + params_.boot_time;
}

void RplidarDevice::wake_up() {
  booted_at_.reset();
  const std::string banner = "RP LIDAR System.\r\nFirmware Ver " + std::to_string(params_.info.firmware.major) + "." +
                             std::to_string(params_.info.firmware.minor) + " Rel, HW Ver " +
                             std::to_string(params_.info.hardware) +
                             "\r\nModel: " + std::to_string(params_.info.model) + "\r\n";
  send(std::vector<std::uint8_t>(banner.begin(), banner.end()));
}

void RplidarDevice::stop_for_protection(std::uint16_t code) {
  health_ = {rplidar::HealthStatus::kProtectionStop, code};
  end_scan();
}

void RplidarDevice::warn(std::uint16_t code) { health_ = {rplidar::HealthStatus::kWarning, code}; }

void RplidarDevice::block_rotor(bool blocked) {
  blocked_ = blocked;
  stuck_for_ = {};
}

void RplidarDevice::end_scan() {
  stream_ = Stream::kNone;
  forced_ = false;
}

Duration RplidarDevice::sample_period() const {
  return stream_ == Stream::kExpress ? params_.express_period : params_.legacy_period;
}

double RplidarDevice::target_hz() const {
  if (!params_.accessory_board) {
    return params_.rotation_hz;
  }
  return params_.rotation_hz * pwm_ / static_cast<double>(params_.full_pwm);
}

void RplidarDevice::advance(RobotTime now) {
  if (!time_) {
    time_ = now;
  }
  if (scanning()) {
    time_ = std::max(*time_, now - kMaxCatchUp);
  }
  // A protection stop in between ends the scan.
  while (scanning() && *time_ + sample_period() <= now) {
    *time_ += sample_period();
    advance_rotor(sample_period());
    if (scanning() && (forced_ || rotor_.rate_hz() >= params_.least_rotation_hz)) {
      take_sample();
    } else {
      gathered_ = 0;
    }
  }
  if (!scanning() && now > *time_) {
    advance_rotor(now - *time_);
    time_ = now;
  }
}

void RplidarDevice::advance_rotor(Duration passed) {
  if (!blocked_) {
    return rotor_.advance(passed, target_hz());
  }
  rotor_.block();
  stuck_for_ += target_hz() > 0.0 ? passed : Duration::zero();
  if (stuck_for_ >= params_.stuck_time && health_.status != rplidar::HealthStatus::kProtectionStop) {
    stop_for_protection(kStuckCode);
  }
}

void RplidarDevice::take_sample() {
  const Measured measured = measure();
  if (stream_ == Stream::kExpress) {
    gather(measured);
  } else {
    send_legacy(measured);
  }
  last_raw_q6_ = measured.raw_angle_q6;
}

RplidarDevice::Measured RplidarDevice::measure() const {
  const double raw_rad = rotor_.angle_cw_rad();
  Measured measured;
  measured.raw_angle_q6 = static_cast<std::uint16_t>(
      static_cast<int>(std::lround(raw_rad / kTwoPi * kQ6PerRevolution)) % rplidar::kRevolutionQ6);
  const auto range_at = [&](double angle_cw_rad) {
    const std::optional<double> range_m = measure_(wrap_angle(-angle_cw_rad), *time_);
    const bool echo = range_m && *range_m > 0.0 && *range_m <= params_.range_max_m;
    return echo ? range_m : std::nullopt;
  };
  measured.range_m = range_at(raw_rad);
  if (measured.range_m) {
    const double offset_q3 = std::round(kQ3PerRad * std::atan2(params_.beam_offset_m, *measured.range_m));
    measured.compensation_q3 = static_cast<std::uint8_t>(std::clamp(offset_q3, 0.0, kMaxCompensationQ3));
    measured.range_m = range_at(raw_rad - measured.compensation_q3 / kQ3PerRad);
  }
  return measured;
}

void RplidarDevice::send_legacy(const Measured& measured) {
  constexpr int kQ6PerQ3 = 8;
  const int angle_q6 = measured.raw_angle_q6 - kQ6PerQ3 * measured.compensation_q3;
  rplidar::LegacySample sample;
  sample.begins_revolution = last_raw_q6_ && measured.raw_angle_q6 < *last_raw_q6_;
  sample.angle_q6 = static_cast<std::uint16_t>((angle_q6 + rplidar::kRevolutionQ6) % rplidar::kRevolutionQ6);
  if (measured.range_m) {
    const double distance_q2 = std::round(*measured.range_m * kQ2PerMetre);
    sample.distance_q2 = static_cast<std::uint16_t>(std::clamp(distance_q2, 1.0, 65'535.0));
    sample.quality = params_.quality;
  }
  send(rplidar::encode(sample));
}

void RplidarDevice::gather(const Measured& measured) {
  constexpr double kMillimetresPerMetre = 1000.0;
  if (gathered_ == 0) {
    capsule_.start_angle_q6 = measured.raw_angle_q6;
  }
  rplidar::CapsuleSample& sample = capsule_.samples[gathered_];
  sample.compensation_q3 = measured.compensation_q3;
  sample.distance_mm = 0;
  if (measured.range_m) {
    const double distance_mm = std::round(*measured.range_m * kMillimetresPerMetre);
    sample.distance_mm =
        static_cast<std::uint16_t>(std::clamp(distance_mm, 1.0, static_cast<double>(rplidar::kMaxCapsuleDistance_mm)));
  }
  if (++gathered_ == rplidar::kCapsuleSamples) {
    send(rplidar::encode(capsule_));
    gathered_ = 0;
    capsule_.first = false;
  }
}

}  // namespace seeker::emulator
