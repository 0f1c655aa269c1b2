/// \file
/// What RplidarDevice does upon each request of its host.
#include <cmath>
#include <string>

#include "server/emulator/devices/rplidar_device.hpp"
#include "server/protocols/rplidar/descriptor.hpp"
#include "server/protocols/rplidar/legacy_sample.hpp"
#include "server/protocols/rplidar/little_endian.hpp"

namespace seeker::emulator {
namespace {

using rplidar::AnswerType;
using rplidar::Command;
using rplidar::ConfType;

/// Modes of a scan, and which of them sends capsules by the configuration.
constexpr std::uint8_t kModes = 2;
constexpr std::uint8_t kExpressMode = 1;
/// From this firmware on the device answers to questions for its configuration.
constexpr rplidar::Firmware kFirstWithConf{1, 24};
constexpr double kQ8 = 256.0;
constexpr double kSecondsPerMinute = 60.0;

}  // namespace

void RplidarDevice::handle(const rplidar::Request& request, RobotTime now) {
  // Programs change the speed of the motor while they scan; other requests end the scan.
  if (request.command != Command::kSetMotorPwm) {
    end_scan();
  }
  switch (request.command) {
    case Command::kReset: return boot(now);
    case Command::kScan: return start(Stream::kLegacy, false, now);
    case Command::kForceScan: return start(Stream::kLegacy, true, now);
    case Command::kExpressScan:
      if (!request.payload.empty() && request.payload[0] < kModes) {
        start(Stream::kExpress, false, now);
      }
      return;
    case Command::kGetInfo: return send(rplidar::encode(params_.info));
    case Command::kGetHealth: return send(rplidar::encode(health_));
    case Command::kGetSampleRate: {
      const auto us = [](Duration period) {
        return static_cast<std::uint16_t>(std::chrono::duration_cast<std::chrono::microseconds>(period).count());
      };
      return send(rplidar::encode(rplidar::SampleRate{us(params_.legacy_period), us(params_.express_period)}));
    }
    case Command::kGetConf: return answer_conf(request);
    case Command::kSetMotorPwm:
      if (params_.accessory_board && request.payload.size() == sizeof(std::uint16_t)) {
        pwm_ = rplidar::read_u16(request.payload, 0);
      }
      return;
    case Command::kGetAccBoardFlag: return send(rplidar::encode(rplidar::AccBoard{params_.accessory_board}));
    case Command::kStop:
    case Command::kSetMotorRpm: return;
  }
}

void RplidarDevice::answer_conf(const rplidar::Request& request) {
  constexpr std::size_t kModeAt = 4;
  if (params_.info.firmware < kFirstWithConf || request.payload.size() < kModeAt) {
    return;
  }
  const bool has_mode = request.payload.size() >= kModeAt + sizeof(std::uint16_t);
  const std::uint16_t mode = has_mode ? rplidar::read_u16(request.payload, kModeAt) : std::uint16_t{0};
  if (mode >= kModes) {
    return;
  }
  const bool express = mode == kExpressMode;
  const auto q8 = [](double value) { return static_cast<std::uint32_t>(std::lround(value * kQ8)); };
  rplidar::ConfAnswer answer{static_cast<ConfType>(rplidar::read_u32(request.payload, 0)), {}};
  switch (answer.type) {
    case ConfType::kDesiredSpeed:
      rplidar::write_u16(static_cast<std::uint16_t>(std::lround(params_.rotation_hz * kSecondsPerMinute)), answer.data);
      rplidar::write_u16(params_.full_pwm, answer.data);
      break;
    case ConfType::kModeCount: rplidar::write_u16(kModes, answer.data); break;
    case ConfType::kSamplePeriod:
      rplidar::write_u32(q8(1e6 * to_seconds(express ? params_.express_period : params_.legacy_period)), answer.data);
      break;
    case ConfType::kMaxDistance: rplidar::write_u32(q8(params_.range_max_m), answer.data); break;
    case ConfType::kAnswerType:
      answer.data.push_back(static_cast<std::uint8_t>(express ? AnswerType::kExpressScan : AnswerType::kLegacyScan));
      break;
    case ConfType::kTypicalMode: rplidar::write_u16(kExpressMode, answer.data); break;
    case ConfType::kModeName: {
      const std::string name = express ? "Express" : "Standard";
      answer.data.assign(name.begin(), name.end());
      answer.data.push_back(0);
      break;
    }
    default: return;
  }
  send(rplidar::encode(answer));
}

void RplidarDevice::start(Stream stream, bool forced, RobotTime now) {
  if (health_.status == rplidar::HealthStatus::kProtectionStop) {
    return;
  }
  const bool express = stream == Stream::kExpress;
  send(rplidar::encode(
      rplidar::Descriptor{static_cast<std::uint32_t>(express ? rplidar::kCapsuleBytes : rplidar::kLegacyBytes), true,
                          express ? AnswerType::kExpressScan : AnswerType::kLegacyScan}));
  stream_ = stream;
  forced_ = forced;
  time_ = now;
  last_raw_q6_.reset();
  gathered_ = 0;
  capsule_ = {};
  capsule_.first = true;
}

}  // namespace seeker::emulator
