/// \file
/// The steps of RplidarSession from the first question to the request for the scan.
#include <string>
#include <variant>

#include "server/drivers/rplidar/rplidar_session.hpp"
#include "server/protocols/rplidar/little_endian.hpp"

namespace seeker::drivers {
namespace {

using rplidar::AnswerType;
using rplidar::Command;
using rplidar::ConfType;

/// From this firmware on devices answer to questions for their configuration.
constexpr rplidar::Firmware kFirstWithConf{1, 24};
/// From this series on an accessory board may switch the motor by request.
constexpr unsigned kFirstSeriesWithBoard = 2;
/// Of devices with a firmware before 1.17, which are not able to say it (protocols 3; the value of the maker's
/// library).
constexpr rplidar::SampleRate kFirstRate{476, 476};
/// Start bit, eight data bits, stop bit.
constexpr double kBitsPerByte = 10.0;
/// Other times from sample to sample than these are damage.
constexpr Duration kLeastSamplePeriod = std::chrono::microseconds(20);
constexpr Duration kMostSamplePeriod = std::chrono::milliseconds(10);
/// The configuration gives microseconds with 8 binary digits behind the point.
constexpr double kSecondsPerQ8 = 1e-6 / 256.0;
constexpr std::uint16_t kMaxMode = 0xFF;

bool possible(Duration sample_period) {
  return sample_period >= kLeastSamplePeriod && sample_period <= kMostSamplePeriod;
}

std::string hex_code(std::uint16_t code) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text = "0x";
  for (unsigned shift = 16; shift > 0; shift -= 4) {
    text += kDigits[(code >> (shift - 4)) & 0xFU];
  }
  return text;
}

}  // namespace

void RplidarSession::unanswered(RobotTime now) {
  switch (step_) {
    case Step::kInfo: return try_next_baud(now);
    case Step::kHealth:
      return give_up(Errc::kLinkLost,
                     "the RPLIDAR told what it is but not how it fares; check its cable and that no other program uses "
                     "the port");
    case Step::kSampleRate: found_.rate = kFirstRate; return choose_motor(now);
    case Step::kAccBoard: return choose_mode(now);
    case Step::kTypicalMode:
    case Step::kModeAnswer:
    case Step::kModePeriod:
      found_.mode = 0;  // the mode that every firmware has; its period is known already
      return start_scan(now);
    case Step::kStarting:
      if (params_.scan_mode == RplidarScanMode::kAutomatic && !found_.legacy) {
        found_.legacy = true;
        return start_scan(now);
      }
      return restart("it did not start the scan", now);
    default: return;
  }
}

void RplidarSession::try_next_baud(RobotTime now) {
  if (++bauds_tried_ >= params_.bauds.size()) {
    return give_up(Errc::kLinkLost,
                   "no RPLIDAR answers at any of the rates tried; check that it has power, that the "
                   "port is the right one, and `bauds`");
  }
  baud_ = (baud_ + 1) % params_.bauds.size();
  act(SetBaud{params_.bauds[baud_]});
  stop(now);
}

void RplidarSession::learn_info(const rplidar::DeviceInfo& info, RobotTime now) {
  found_.info = info;
  bauds_tried_ = 0;
  ask(Step::kHealth, {Command::kGetHealth, {}}, AnswerType::kHealth, now);
}

void RplidarSession::learn_health(const rplidar::Health& health, RobotTime now) {
  warning_.reset();
  if (health.status == rplidar::HealthStatus::kWarning) {
    warning_ = Error{Errc::kInternal, "the RPLIDAR warns of fault " + hex_code(health.code) +
                                          "; it measures, but clean it and see that its rotor runs freely"};
  }
  if (health.status != rplidar::HealthStatus::kProtectionStop) {
    return ask(Step::kSampleRate, {Command::kGetSampleRate, {}}, AnswerType::kSampleRate, now);
  }
  if (resets_ >= params_.resets) {
    return give_up(Errc::kInternal, "the RPLIDAR is in protection stop, fault " + hex_code(health.code) +
                                        ", and resets do not help; see that its rotor runs freely and that its power "
                                        "supply is strong enough");
  }
  ++resets_;
  step_ = Step::kBooting;
  send({Command::kReset, {}});
  pause_until_ = now + params_.boot_time;
}

void RplidarSession::learn_rate(const rplidar::SampleRate& rate, RobotTime now) {
  found_.rate = rate;
  if (!possible(std::chrono::microseconds(rate.legacy_us)) || !possible(std::chrono::microseconds(rate.express_us))) {
    return unanswered(now);
  }
  choose_motor(now);
}

void RplidarSession::choose_motor(RobotTime now) {
  if (params_.motor == RplidarMotor::kAutomatic && found_.info.series() >= kFirstSeriesWithBoard) {
    return ask(Step::kAccBoard, rplidar::get_acc_board_flag(), AnswerType::kAccBoard, now);
  }
  found_.motor_by_pwm = params_.motor == RplidarMotor::kPwm;
  choose_mode(now);
}

void RplidarSession::choose_mode(RobotTime now) {
  found_.legacy = params_.scan_mode == RplidarScanMode::kLegacy;
  found_.mode = 0;
  found_.sample_period = std::chrono::microseconds(found_.rate.express_us);
  if (found_.legacy || found_.info.firmware < kFirstWithConf) {
    return start_scan(now);
  }
  asked_conf_ = ConfType::kTypicalMode;
  ask(Step::kTypicalMode, rplidar::get_conf(ConfType::kTypicalMode), AnswerType::kConf, now);
}

void RplidarSession::ask_conf(Step step, ConfType type, RobotTime now) {
  asked_conf_ = type;
  ask(step, rplidar::get_conf(type, found_.typical_mode), AnswerType::kConf, now);
}

bool RplidarSession::learn_conf(const rplidar::ConfAnswer& conf, RobotTime now) {
  const std::span<const std::uint8_t> data = conf.data;
  if (step_ == Step::kTypicalMode && data.size() == sizeof(std::uint16_t)) {
    found_.typical_mode = rplidar::read_u16(data, 0);
    ask_conf(Step::kModeAnswer, ConfType::kAnswerType, now);
    return true;
  }
  if (step_ == Step::kModeAnswer && data.size() == 1) {
    const bool capsules = data[0] == static_cast<std::uint8_t>(AnswerType::kExpressScan);
    if (!capsules || found_.typical_mode > kMaxMode) {
      return false;  // samples are sent in a way that only newer devices have
    }
    ask_conf(Step::kModePeriod, ConfType::kSamplePeriod, now);
    return true;
  }
  if (step_ == Step::kModePeriod && data.size() == sizeof(std::uint32_t)) {
    const Duration period = seconds(kSecondsPerQ8 * rplidar::read_u32(data, 0));
    if (!possible(period)) {
      return false;
    }
    found_.mode = static_cast<std::uint8_t>(found_.typical_mode);
    found_.sample_period = period;
    start_scan(now);
    return true;
  }
  return false;
}

void RplidarSession::start_scan(RobotTime now) {
  if (found_.motor_by_pwm) {
    send(rplidar::set_motor_pwm(params_.motor_pwm));
  }
  if (found_.legacy) {
    found_.sample_period = std::chrono::microseconds(found_.rate.legacy_us);
    ask(Step::kStarting, {Command::kScan, {}}, AnswerType::kLegacyScan, now);
  } else {
    ask(Step::kStarting, rplidar::express_scan(found_.mode), AnswerType::kExpressScan, now);
  }
  stream_.start(found_.sample_period, seconds(kBitsPerByte / params_.bauds[baud_]));
}

}  // namespace seeker::drivers
