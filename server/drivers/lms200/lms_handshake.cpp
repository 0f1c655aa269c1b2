#include "server/drivers/lms200/lms_handshake.hpp"

#include <algorithm>
#include <utility>

#include "common/core/assert.hpp"
#include "server/protocols/lms200/baud_rate.hpp"
#include "server/protocols/lms200/responses.hpp"
#include "server/protocols/lms200/status_block.hpp"
#include "server/protocols/lms200/telegram.hpp"

namespace seeker::drivers {
namespace {

namespace lms = lms200;
namespace code = lms200::response_code;

std::vector<std::uint32_t> search_order(const LmsParams& params) {
  std::vector<std::uint32_t> rates{params.baud};
  rates.reserve(1 + params.search_bauds.size());
  for (const std::uint32_t baud : params.search_bauds) {
    if (std::find(rates.begin(), rates.end(), baud) == rates.end()) {
      rates.push_back(baud);
    }
  }
  return rates;
}

std::string list_of(const std::vector<std::uint32_t>& rates) {
  std::string text;
  for (const std::uint32_t baud : rates) {
    text += (text.empty() ? "" : ", ") + std::to_string(baud);
  }
  return text;
}

template <class T>
Status status_of(const Result<T>& result) {
  return result ? Status() : Status(tl::unexpected<Error>(result.error()));
}

}  // namespace

LmsHandshake::LmsHandshake(const LmsParams& params, LmsHealth& health)
    : params_(params), health_(health), rates_(search_order(params)) {}

LmsHandshake::Work LmsHandshake::work_of(Step step) const {
  const lms::SetMode request{lms::operating_mode::kRequest, {}};
  const lms::SetMode rate{lms::baud_mode(params_.baud).value_or(0), {}};
  const lms::SetMode output = params_.sub_range ? lms::continuous_sub_range(*params_.sub_range)
                                                : lms::SetMode{lms::operating_mode::kContinuous, {}};
  const double reply_s = params_.reply_timeout_s;
  const double mode_s = params_.mode_timeout_s;
  switch (step) {
    case Step::kSearch: return {request, code::kMode, reply_s, "the request mode"};
    case Step::kSetBaud: return {rate, code::kMode, reply_s, "the change of its rate"};
    case Step::kConfirmBaud: return {request, code::kMode, mode_s, "the request mode at its new rate"};
    case Step::kType: return {lms::RequestType{}, code::kType, reply_s, "the question for its type"};
    case Step::kStatus: return {lms::RequestStatus{}, code::kStatus, reply_s, "the question for its status"};
    case Step::kErrors: return {lms::RequestErrors{}, code::kErrors, reply_s, "the question for its errors"};
    case Step::kVariant: return {lms::SetVariant{params_.variant}, code::kVariant, mode_s, "the choice of its variant"};
    case Step::kReadConfig: return {lms::RequestConfig{}, code::kConfig, reply_s, "the question for its configuration"};
    case Step::kInstallation: return {lms::enter_installation(), code::kMode, mode_s, "the installation mode"};
    case Step::kWriteConfig: {
      const auto block = encode(wanted_config());
      return {lms::SetConfig{{block.begin(), block.end()}}, code::kConfigWritten, params_.flash_timeout_s,
              "its new configuration"};
    }
    case Step::kOutput:
    case Step::kDone: break;
  }
  return {output, code::kMode, mode_s, "the start of its output"};
}

double LmsHandshake::longest_telegram_s() const {
  return to_seconds(lms::transfer_time(lms::kMaxTelegramBytes, baud_));
}

void LmsHandshake::begin(RobotTime now) {
  actions_.clear();
  failure_.reset();
  health_.restart();
  rounds_ = 0;
  rate_ = 0;
  change_rate(rates_.front());
  enter(Step::kSearch, now);
}

void LmsHandshake::enter(Step step, RobotTime now, double pause_s) {
  step_ = step;
  tries_ = 0;
  deadline_.reset();
  send_at_.reset();
  if (step == Step::kDone) {
    return;
  }
  if (pause_s > 0.0) {
    send_at_ = now + seconds(pause_s);
  } else {
    send(now);
  }
}

void LmsHandshake::send(RobotTime now) {
  const Work work = work_of(step_);
  const std::vector<std::uint8_t> payload = encode(work.command);
  actions_.push_back(WriteBytes{encode_telegram(lms::Sender::kHost, payload)});
  ++tries_;
  send_at_.reset();
  // The answer may wait behind a scan that is on the line.
  deadline_ = now + seconds(work.timeout_s + longest_telegram_s());
}

void LmsHandshake::change_rate(std::uint32_t baud) {
  baud_ = baud;
  actions_.push_back(SetBaud{baud});
  actions_.push_back(DropInput{});
}

void LmsHandshake::fail_with(Errc code, std::string message) {
  failure_ = Error{code, std::move(message)};
  send_at_.reset();
  deadline_.reset();
}

void LmsHandshake::pass(RobotTime now) {
  if (send_at_ && now >= *send_at_) {
    send(now);
  }
  if (deadline_ && now >= *deadline_) {
    unanswered(now);
  }
}

RobotTime LmsHandshake::wake() const {
  return std::min(send_at_.value_or(RobotTime::max()), deadline_.value_or(RobotTime::max()));
}

std::vector<LineAction> LmsHandshake::take_actions() { return std::exchange(actions_, {}); }

void LmsHandshake::unanswered(RobotTime now) {
  if (tries_ < (step_ == Step::kSearch ? params_.search_tries : params_.tries)) {
    send(now);
  } else if (step_ == Step::kSearch) {
    search_next(now);
  } else {
    end_round(now);
  }
}

void LmsHandshake::search_next(RobotTime now) {
  ++rate_;
  if (rate_ == rates_.size()) {
    end_round(now);
    return;
  }
  change_rate(rates_[rate_]);
  enter(Step::kSearch, now);
}

void LmsHandshake::end_round(RobotTime now) {
  ++rounds_;
  if (rounds_ >= params_.rounds) {
    fail_with(Errc::kTimeout, step_ == Step::kSearch
                                  ? "no laser scanner LMS200 answers at " + list_of(rates_) +
                                        " baud; check its power, its cable and the name of its port"
                                  : "the laser scanner does not answer to " + std::string(work_of(step_).text) +
                                        "; check its cable and its supply voltage");
    return;
  }
  rate_ = 0;
  change_rate(rates_.front());
  enter(Step::kSearch, now);
}

void LmsHandshake::rejected(const std::string& reason, RobotTime now) {
  if (tries_ < params_.tries) {
    deadline_.reset();
    send_at_ = now + seconds(params_.retry_pause_s);
    return;
  }
  fail_with(Errc::kRefused, "the laser scanner refuses " + std::string(work_of(step_).text) + ": " + reason);
}

void LmsHandshake::refused_damaged(RobotTime now) {
  // Without a deadline nothing is waited for: the byte belongs to an earlier telegram, or to noise.
  if (deadline_ && step_ != Step::kSearch) {
    rejected("it finds the telegrams damaged; check the cable and its shielding", now);
  }
}

void LmsHandshake::answer(std::span<const std::uint8_t> payload, RobotTime now) {
  SEEKER_ASSERT(!payload.empty());
  if (done() || failure_) {
    return;
  }
  const std::uint8_t response = payload.front();
  if (response == code::kPowerOn && step_ != Step::kSearch) {
    end_round(now);  // everything that was set is lost
    return;
  }
  if (!deadline_) {
    return;
  }
  if (response == code::kNotAccepted) {
    rejected("it does not accept the command in its present mode; switch it off and on", now);
  } else if (response == work_of(step_).response) {
    if (health_.fatal()) {
      rejected("it reports a fatal error; switch it off and on, and have it serviced if the error returns", now);
    } else if (Status accepted = accept(payload, now); !accepted) {
      rejected(accepted.error().message, now);
    }
  }
}

Status LmsHandshake::accept(std::span<const std::uint8_t> payload, RobotTime now) {
  switch (step_) {
    case Step::kType: return accept_type(payload, now);
    case Step::kStatus: return accept_status(payload, now);
    case Step::kErrors: return accept_errors(payload, now);
    case Step::kVariant: return accept_variant(payload, now);
    case Step::kReadConfig: return accept_config(payload, now);
    case Step::kWriteConfig: return accept_written(payload, now);
    default: return accept_mode(payload, now);
  }
}

Status LmsHandshake::accept_mode(std::span<const std::uint8_t> payload, RobotTime now) {
  const Result<lms::ModeResult> result = lms::decode_mode_result(payload);
  if (!result) {
    return status_of(result);
  }
  if (*result != lms::ModeResult::kDone) {
    return fail(Errc::kRefused, *result == lms::ModeResult::kFault
                                    ? "it has an internal fault; switch it off and on"
                                    : "it is not able to, or its password was changed; check its type and settings");
  }
  switch (step_) {
    case Step::kSearch:
      original_baud_ = original_baud_.value_or(baud_);
      enter(baud_ == params_.baud ? Step::kType : Step::kSetBaud, now);
      break;
    case Step::kSetBaud:
      change_rate(params_.baud);
      enter(Step::kConfirmBaud, now, params_.baud_settle_s);
      break;
    case Step::kConfirmBaud: enter(Step::kType, now); break;
    case Step::kInstallation: enter(Step::kWriteConfig, now); break;
    default: enter(Step::kDone, now); break;
  }
  return {};
}

Status LmsHandshake::accept_type(std::span<const std::uint8_t> payload, RobotTime now) {
  const Result<std::string> type = lms::decode_text(payload);
  if (!type) {
    return status_of(type);
  }
  if (!type->starts_with("LMS")) {
    return fail(Errc::kUnsupportedVersion,
                "it says that it is '" + *type + "', not an LMS2xx; check the name of its port");
  }
  enter(Step::kStatus, now);
  return {};
}

Status LmsHandshake::accept_status(std::span<const std::uint8_t> payload, RobotTime now) {
  const Result<lms::StatusBlock> block = lms::decode_status_block(payload);
  if (!block) {
    return status_of(block);
  }
  enter(block->defective ? Step::kErrors : Step::kVariant, now);
  return {};
}

Status LmsHandshake::accept_errors(std::span<const std::uint8_t> payload, RobotTime now) {
  Result<std::vector<lms::DeviceError>> errors = lms::decode_errors(payload);
  if (!errors) {
    return status_of(errors);
  }
  health_.note_errors(std::move(*errors));
  enter(Step::kVariant, now);
  return {};
}

Status LmsHandshake::accept_variant(std::span<const std::uint8_t> payload, RobotTime now) {
  const Result<lms::VariantReply> reply = lms::decode_variant(payload);
  if (!reply) {
    return status_of(reply);
  }
  if (!reply->accepted || reply->variant != params_.variant) {
    return fail(Errc::kRefused, "it has no " + to_string(params_.variant) + "; choose another variant");
  }
  enter(Step::kReadConfig, now);
  return {};
}

lms::ConfigBlock LmsHandshake::wanted_config() const {
  lms::ConfigBlock wanted = config_;
  wanted.unit = static_cast<std::uint8_t>(params_.unit);
  wanted.measuring_mode = static_cast<std::uint8_t>(params_.measuring_mode);
  return wanted;
}

Status LmsHandshake::accept_config(std::span<const std::uint8_t> payload, RobotTime now) {
  const Result<lms::ConfigBlock> config = lms::decode_config_reply(payload);
  if (!config) {
    return status_of(config);
  }
  config_ = *config;
  if (config_ != wanted_config() && params_.may_write_flash) {
    enter(Step::kInstallation, now);
    return {};
  }
  const auto mode = lms::measuring_mode_of(config_.measuring_mode);
  if (!mode || *mode == lms::MeasuringMode::kReflectivity) {
    return fail(Errc::kRefused, "it measures in mode " + std::to_string(config_.measuring_mode) +
                                    ", which gives no ranges; allow may_write_flash once");
  }
  use_config(now);
  return {};
}

Status LmsHandshake::accept_written(std::span<const std::uint8_t> payload, RobotTime now) {
  const Result<lms::ConfigWrittenReply> reply = lms::decode_config_written(payload);
  if (!reply) {
    return status_of(reply);
  }
  if (!reply->accepted || reply->config != wanted_config()) {
    return fail(Errc::kRefused, "it did not take it over; choose unit and measuring mode that it has");
  }
  config_ = reply->config;
  use_config(now);
  return {};
}

void LmsHandshake::use_config(RobotTime now) {
  health_.note_config(config_);
  enter(Step::kOutput, now);
}

Error LmsHandshake::progress() const {
  return {Errc::kNotReady, step_ == Step::kSearch
                               ? "looks for the laser scanner at " + std::to_string(baud_) + " baud"
                               : "waits for the laser scanner to answer to " + std::string(work_of(step_).text)};
}

}  // namespace seeker::drivers
