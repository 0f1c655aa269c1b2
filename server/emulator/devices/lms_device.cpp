#include "server/emulator/devices/lms_device.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/angle.hpp"
#include "common/core/assert.hpp"
#include "server/emulator/devices/lms_resampling.hpp"
#include "server/protocols/lms200/responses.hpp"
#include "server/protocols/lms200/scan_telegram.hpp"

namespace seeker::emulator {
namespace {

namespace lms = lms200;

/// A mode that is not documented measures as this one.
constexpr auto kDefaultMode = lms::MeasuringMode::k8mFieldsAbDazzle;
constexpr auto kDefaultUnit = lms::Unit::kCentimetre;

std::vector<std::uint16_t> words_of(const std::vector<float>& ranges_m, const lms::ConfigBlock& config) {
  const lms::MeasuringMode mode = lms::measuring_mode_of(config.measuring_mode).value_or(kDefaultMode);
  const lms::Unit unit = lms::unit_of(config.unit).value_or(kDefaultUnit);
  std::vector<std::uint16_t> words(ranges_m.size());
  std::transform(ranges_m.begin(), ranges_m.end(), words.begin(),
                 [&](float range_m) { return lms::word_of(range_m, 0, mode, unit); });
  return words;
}

}  // namespace

LmsDevice::LmsDevice(const LmsDeviceParams& params, LmsScanSource source)
    : params_(params),
      source_(std::move(source)),
      control_(params),
      reader_(lms::Sender::kHost),
      rng_(params.seed),
      baud_(params.power_on_baud) {
  SEEKER_ASSERT(source_ && lms::baud_mode(params.power_on_baud) && is_variant(params.variant));
}

void LmsDevice::receive(std::span<const std::uint8_t> bytes, RobotTime now) {
  pass(now);
  if (off()) {
    return;
  }
  last_byte_ = bytes.empty() ? last_byte_ : now;
  reader_.feed(bytes);
  take_commands(now);
  serve_scans(now);
  output_.release(now, taken_);
}

void LmsDevice::take_commands(RobotTime now) {
  while (const auto received = reader_.next()) {
    if (received->kind == lms::Received::Kind::kTelegram) {
      answer(received->payload, now);
    }
  }
  if (reader_.damaged() > answered_damage_) {
    acknowledge(lms::kNakByte, now);
    answered_damage_ = reader_.damaged();
  }
}

void LmsDevice::acknowledge(std::uint8_t byte, RobotTime now) { output_.send({byte}, now, new_baud_.value_or(baud_)); }

void LmsDevice::answer(std::span<const std::uint8_t> payload, RobotTime now) {
  acknowledge(lms::kAckByte, now);
  const LmsAnswer answer = control_.answer(payload);
  if (!answer.payload.empty()) {
    send(answer.payload, now + seconds(answer.delay_s));
  }
  if (answer.new_baud) {
    new_baud_ = answer.new_baud;
    change_baud_at_ = output_.free_at();
    control_.set_baud(*answer.new_baud);
  }
  if (answer.restarts) {
    restart_at_ = output_.free_at();
  }
  if (!control_.continuous() && !control_.scan_requested()) {
    planned_.reset();
  }
}

void LmsDevice::send(std::span<const std::uint8_t> payload, RobotTime earliest) {
  std::vector<std::uint8_t> telegram = encode_telegram(lms::Sender::kDevice, payload);
  if (rng_.uniform() < control_.faults().wrong_crc) {
    telegram.back() = static_cast<std::uint8_t>(~telegram.back());
  }
  output_.send(std::move(telegram), earliest, new_baud_.value_or(baud_));
}

void LmsDevice::pass(RobotTime now) {
  serve_power(now);
  if (!off()) {
    if (reader_.partial() && now >= last_byte_ + seconds(params_.partial_timeout_s)) {
      while (reader_.partial()) {
        reader_.abandon_partial();
        take_commands(now);
      }
    }
    serve_scans(now);
  }
  output_.release(now, taken_);
  if (new_baud_ && now >= change_baud_at_) {
    baud_ = *std::exchange(new_baud_, std::nullopt);
  }
}

void LmsDevice::serve_power(RobotTime now) {
  if (restart_at_ && now >= *restart_at_) {
    output_.release(now, taken_);
    restart(*restart_at_);
  }
  if (ready_at_ && now >= *ready_at_) {
    const RobotTime ready_at = *std::exchange(ready_at_, std::nullopt);
    send(lms::encode_text(lms::response_code::kPowerOn, params_.type, control_.status().raw()), ready_at);
  }
}

void LmsDevice::restart(RobotTime at) {
  output_.clear();
  control_.restart();
  reader_.clear();
  planned_.reset();
  new_baud_.reset();
  restart_at_.reset();
  baud_ = params_.power_on_baud;
  ready_at_ = at + seconds(params_.start_up_s);
}

void LmsDevice::power_cycle(RobotTime now) {
  taken_.clear();
  restart(now);
}

LmsDevice::PlannedScan LmsDevice::plan(RobotTime after) const {
  const int rotations = control_.variant().mirror_rotations();
  const double scan_s = rotations * kMirrorPeriod_s;
  const double field_s = kMirrorPeriod_s * deg_to_rad(control_.variant().angle_deg) / kTwoPi;
  const double lasts_s = scan_s - kMirrorPeriod_s + field_s;
  // The first scan that begins from now on and ends when the line is free.
  const double begin_s =
      std::max(to_seconds(after), output_.free_at() > after ? to_seconds(output_.free_at()) - lasts_s : 0.0);
  const auto scan = static_cast<std::int64_t>(std::ceil(std::max(begin_s, 0.0) / scan_s));
  const double start_s = static_cast<double>(scan) * scan_s;
  return {robot_time_s(start_s + lasts_s / 2.0), robot_time_s(start_s + lasts_s), (scan + 1) * rotations, std::nullopt};
}

void LmsDevice::serve_scans(RobotTime now) {
  if (!control_.continuous() && !control_.scan_requested()) {
    return;
  }
  if (!planned_) {
    planned_ = plan(now);
  }
  if (!planned_->measured && now >= planned_->middle) {
    planned_->measured = source_(now);
  }
  if (planned_->measured && now >= planned_->end) {
    if (output_.free_at() <= planned_->end) {
      send_scan(*planned_);
    }
    planned_.reset();
    if (control_.continuous() || control_.scan_requested()) {
      planned_ = plan(now);
    }
  }
}

void LmsDevice::send_scan(const PlannedScan& scan) {
  lms::ScanTelegram telegram;
  telegram.unit = lms::unit_of(control_.flash().unit).value_or(kDefaultUnit);
  telegram.sub_range = control_.sub_range();
  telegram.words = words_of(resampled(*scan.measured, control_.variant()), control_.flash());
  if (telegram.sub_range) {
    const auto first = telegram.words.begin();
    telegram.words = {first + telegram.sub_range->first - 1, first + telegram.sub_range->last};
  }
  if (control_.flash().real_time_index()) {
    telegram.real_time_index = static_cast<std::uint8_t>(scan.rotation & 0xFF);
  }
  if (params_.sends_telegram_index) {
    telegram.telegram_index = telegrams_sent_;
  }
  ++telegrams_sent_;
  control_.scan_sent();
  send(encode(telegram, control_.status().raw()), scan.end);
}

RobotTime LmsDevice::wake() const {
  RobotTime next = std::min({output_.next_start(), new_baud_ ? change_baud_at_ : RobotTime::max(),
                             restart_at_.value_or(RobotTime::max()), ready_at_.value_or(RobotTime::max())});
  if (!off() && planned_) {
    next = std::min(next, planned_->measured ? planned_->end : planned_->middle);
  }
  if (!off() && reader_.partial()) {
    next = std::min(next, last_byte_ + seconds(params_.partial_timeout_s));
  }
  return next;
}

std::vector<std::uint8_t> LmsDevice::take_output() { return std::exchange(taken_, {}); }

}  // namespace seeker::emulator
