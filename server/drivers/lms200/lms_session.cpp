#include "server/drivers/lms200/lms_session.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "common/core/assert.hpp"
#include "server/protocols/lms200/baud_rate.hpp"
#include "server/protocols/lms200/responses.hpp"
#include "server/protocols/lms200/telegram.hpp"

namespace seeker::drivers {
namespace {

Duration byte_time(const LmsParams& params) {
  return params.line_keeps_rate ? lms200::transfer_time(1, params.baud) : Duration(0);
}

bool is_scan(std::uint8_t response) {
  return response == lms200::response_code::kValues || response == lms200::response_code::kSubRange;
}

std::size_t written_bytes(const std::vector<LineAction>& actions) {
  std::size_t bytes = 0;
  for (const LineAction& action : actions) {
    const auto* write = std::get_if<WriteBytes>(&action);
    bytes += write != nullptr ? write->bytes.size() : 0;
  }
  return bytes;
}

WriteBytes mode_command(std::uint8_t mode) {
  return {encode_telegram(lms200::Sender::kHost, encode(lms200::Command(lms200::SetMode{mode, {}})))};
}

}  // namespace

LmsSession::LmsSession(const LmsParams& params)
    : params_(params),
      health_(params),
      handshake_(params_, health_),
      maker_(params),
      reader_(lms200::Sender::kDevice),
      arrivals_(byte_time(params)) {
  SEEKER_ASSERT(validate(params).has_value());
}

void LmsSession::open(RobotTime now) {
  actions_.clear();
  failure_.reset();
  scan_.reset();
  scans_come_ = false;
  reader_.clear();
  maker_.restart();
  phase_ = Phase::kHandshake;
  last_byte_ = now;
  handshake_.begin(now);
  advance(now);
}

void LmsSession::receive(std::span<const std::uint8_t> bytes, RobotTime now) {
  arrivals_.note(reader_.bytes_in(), bytes.size(), now);
  reader_.feed(bytes);
  last_byte_ = bytes.empty() ? last_byte_ : now;
  drain(now);
  advance(now);
}

void LmsSession::drain(RobotTime now) {
  while (const auto received = reader_.next()) {
    handle(*received, now);
  }
}

void LmsSession::handle(const lms200::Received& received, RobotTime now) {
  if (phase_ == Phase::kClosed || failure_) {
    return;
  }
  if (received.kind == lms200::Received::Kind::kTelegram) {
    take_telegram(received, now);
  } else if (received.kind == lms200::Received::Kind::kNak && phase_ == Phase::kHandshake) {
    handshake_.refused_damaged(now);
  }
}

void LmsSession::take_telegram(const lms200::Received& received, RobotTime now) {
  health_.note(lms200::StatusByte(received.payload.back()));
  if (phase_ == Phase::kHandshake) {
    handshake_.answer(received.payload, now);
    advance(now);
  } else if (is_scan(received.payload.front())) {
    take_scan_telegram(received, now);
  } else if (received.payload.front() == lms200::response_code::kPowerOn) {
    failure_ = Error{Errc::kLinkLost, "the laser scanner has started again; check its supply voltage"};
  }
}

void LmsSession::take_scan_telegram(const lms200::Received& received, RobotTime now) {
  const auto mode = lms200::measuring_mode_of(handshake_.config().measuring_mode);
  const auto telegram = lms200::decode_scan(received.payload, handshake_.config().real_time_index());
  if (!telegram || !mode) {
    ++statistics_.packets_bad;
    return;
  }
  Result<LaserScan> scan = maker_.make(*telegram, *mode, arrivals_.latest_arrival(received.first_byte));
  if (!scan) {
    ++statistics_.packets_bad;
    return;
  }
  if (health_.fatal()) {
    return;
  }
  last_scan_ = now;
  at_last_scan_ = statistics();
  scans_come_ = true;
  if (!last_stamp_ || scan->stamp > *last_stamp_) {
    last_stamp_ = scan->stamp;
    scan_ = std::move(*scan);
  }
}

void LmsSession::advance(RobotTime now) {
  if (phase_ != Phase::kHandshake) {
    return;
  }
  perform_drops();
  failure_ = handshake_.failure();
  if (handshake_.done()) {
    phase_ = Phase::kStreaming;
    last_scan_ = now;
    at_last_scan_ = statistics();
    ++statistics_.connects;
  }
}

void LmsSession::perform_drops() {
  for (LineAction& action : handshake_.take_actions()) {
    if (std::holds_alternative<DropInput>(action)) {
      reader_.clear();
    }
    actions_.push_back(std::move(action));
  }
}

void LmsSession::pass(RobotTime now) {
  if (phase_ == Phase::kClosed || failure_) {
    return;
  }
  if (reader_.partial() && now >= last_byte_ + seconds(params_.partial_timeout_s)) {
    while (reader_.partial()) {
      reader_.abandon_partial();
      drain(now);
    }
  }
  if (phase_ == Phase::kHandshake) {
    handshake_.pass(now);
    advance(now);
  } else if (!failure_ && now >= last_scan_ + seconds(params_.scan_timeout_s)) {
    lose(now);
  }
}

RobotTime LmsSession::wake() const {
  if (phase_ == Phase::kClosed || failure_) {
    return RobotTime::max();
  }
  const RobotTime next = phase_ == Phase::kHandshake ? handshake_.wake() : last_scan_ + seconds(params_.scan_timeout_s);
  return reader_.partial() ? std::min(next, last_byte_ + seconds(params_.partial_timeout_s)) : next;
}

std::vector<LineAction> LmsSession::take_actions() {
  statistics_.bytes_out += written_bytes(actions_);
  return std::exchange(actions_, {});
}

void LmsSession::lose(RobotTime now) {
  failure_ = Error{Errc::kLinkLost, "no scan of the laser scanner for " +
                                        std::to_string(static_cast<int>(to_seconds(now - last_scan_) * 1e3)) +
                                        " ms: " + cause_of_silence(now)};
}

std::string LmsSession::cause_of_silence(RobotTime now) const {
  if (now - last_byte_ >= seconds(params_.scan_timeout_s / 2.0)) {
    return "it sends nothing; check its power and its cable";
  }
  if (health_.fatal()) {
    return health_.warning()->message;
  }
  const LinkStatistics all = statistics();
  if (all.bytes_skipped - at_last_scan_.bytes_skipped > (all.bytes_in - at_last_scan_.bytes_in) / 2) {
    return "what it sends is damaged or comes at another rate; check its cable, and that nobody else uses its port";
  }
  return "what it sends are no scans as they were asked for; check that nobody else uses its port";
}

void LmsSession::close(RobotTime /*now*/) {
  if (phase_ != Phase::kClosed && handshake_.found()) {
    actions_.emplace_back(mode_command(lms200::operating_mode::kRequest));
    const std::uint32_t original = handshake_.original_baud().value_or(handshake_.baud());
    if (original != handshake_.baud()) {
      actions_.emplace_back(mode_command(lms200::baud_mode(original).value()));
      actions_.emplace_back(SetBaud{original});
    }
  }
  phase_ = Phase::kClosed;
}

Status LmsSession::state() const {
  if (failure_) {
    return tl::unexpected<Error>(*failure_);
  }
  switch (phase_) {
    case Phase::kClosed: return fail(Errc::kNotReady, "the line to the laser scanner is not open");
    case Phase::kHandshake: return tl::unexpected<Error>(handshake_.progress());
    case Phase::kStreaming: break;
  }
  return scans_come_ ? Status() : fail(Errc::kNotReady, "waits for the first scan of the laser scanner");
}

LinkStatistics LmsSession::statistics() const {
  LinkStatistics all = statistics_;
  all.bytes_in = reader_.bytes_in();
  all.packets_in = reader_.telegrams() - statistics_.packets_bad;
  all.packets_bad += reader_.damaged();
  all.bytes_skipped = reader_.bytes_skipped();
  return all;
}

std::optional<LaserScan> LmsSession::take_scan() { return std::exchange(scan_, std::nullopt); }

std::optional<Error> LmsSession::warning() const {
  return phase_ == Phase::kStreaming && !failure_ ? health_.warning() : std::nullopt;
}

}  // namespace seeker::drivers
