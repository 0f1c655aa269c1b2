#include "server/emulator/devices/lms_control.hpp"

#include <algorithm>
#include <utility>

#include "server/protocols/lms200/status_block.hpp"

namespace seeker::emulator {
namespace {

namespace lms = lms200;
namespace mode_code = lms200::operating_mode;

constexpr std::uint8_t kAllValues = 1;
constexpr std::uint8_t kAddress = 0;
/// Readings of the window's sectors, clean and dirty: what counts is the ratio to the calibration.
constexpr std::uint16_t kCleanWindow = 800;
constexpr std::uint16_t kDirtyWindow = 400;
/// Entries of the error list.
constexpr lms::DeviceError kFatalError{static_cast<std::uint8_t>(lms::StatusByte::Level::kFatal), 1};
constexpr lms::DeviceError kPollutionWarning{static_cast<std::uint8_t>(lms::StatusByte::Level::kWarning), 2};

bool is_password(const std::vector<std::uint8_t>& bytes) {
  return std::equal(bytes.begin(), bytes.end(), lms::kPassword.begin(), lms::kPassword.end());
}

LmsAnswer reply(std::vector<std::uint8_t> payload) {
  LmsAnswer answer;
  answer.payload = std::move(payload);
  return answer;
}

}  // namespace

LmsControl::LmsControl(const LmsDeviceParams& params)
    : params_(params), flash_(params.flash), variant_(params.variant), baud_(params.power_on_baud) {}

void LmsControl::restart() {
  variant_ = params_.variant;
  mode_ = mode_code::kRequest;
  scan_requested_ = false;
  baud_ = params_.power_on_baud;
}

lms::StatusByte LmsControl::status() const {
  using Level = lms::StatusByte::Level;
  const Level level = faults_.fatal ? Level::kFatal : faults_.polluted ? Level::kWarning : Level::kNone;
  return lms::StatusByte::of(level, faults_.polluted);
}

bool LmsControl::continuous() const {
  return mode_ == mode_code::kContinuous || mode_ == mode_code::kContinuousSubRange;
}

std::optional<lms::SubRange> LmsControl::sub_range() const {
  return mode_ == mode_code::kContinuousSubRange ? std::optional(sub_range_) : std::nullopt;
}

LmsAnswer LmsControl::answer(std::span<const std::uint8_t> payload) {
  const Result<lms::Command> command = lms::decode_command(payload);
  if (!command) {
    return not_accepted();
  }
  return std::visit([this](const auto& c) { return on(c); }, *command);
}

LmsAnswer LmsControl::not_accepted() const {
  return reply(lms::encode_plain(lms::response_code::kNotAccepted, status().raw()));
}

LmsAnswer LmsControl::on(const lms::Reset& /*command*/) {
  LmsAnswer answer = reply(lms::encode_plain(lms::response_code::kReset, status().raw()));
  answer.restarts = true;
  return answer;
}

LmsAnswer LmsControl::on(const lms::SetMode& command) {
  const std::optional<std::uint32_t> baud = lms::baud_of_mode(command.mode);
  if (baud && command.parameters.empty()) {
    LmsAnswer answer = reply(encode(lms::ModeResult::kDone, status().raw()));
    answer.new_baud = baud;
    return answer;
  }
  return reply(encode(change_mode(command), status().raw()));
}

lms::ModeResult LmsControl::change_mode(const lms::SetMode& command) {
  const bool plain = command.parameters.empty();
  bool allowed = false;
  switch (command.mode) {
    case mode_code::kInstallation: allowed = is_password(command.parameters); break;
    case mode_code::kContinuous:
    case mode_code::kRequest: allowed = plain; break;
    case mode_code::kContinuousSubRange:
      if (const auto range = lms::sub_range_of(command)) {
        allowed = range->first >= 1 && range->first <= range->last && range->last <= variant_.beams();
        sub_range_ = allowed ? *range : sub_range_;
      }
      break;
    default: break;
  }
  if (!allowed) {
    return lms::ModeResult::kRefused;
  }
  mode_ = command.mode;
  scan_requested_ = false;
  return lms::ModeResult::kDone;
}

LmsAnswer LmsControl::on(const lms::RequestValues& command) {
  if (command.kind != kAllValues || mode_ != mode_code::kRequest) {
    return not_accepted();
  }
  scan_requested_ = true;
  return {};
}

LmsAnswer LmsControl::on(const lms::RequestStatus& /*command*/) {
  lms::StatusBlock block;
  block.software_version = params_.software_version;
  block.prom_version = params_.prom_version;
  block.operating_mode = mode_;
  block.defective = faults_.fatal;
  block.pollution.fill(faults_.polluted ? kDirtyWindow : kCleanWindow);
  block.pollution_calibration.fill(kCleanWindow);
  block.reference_pollution.fill(kCleanWindow);
  block.reference_calibration.fill(kCleanWindow);
  block.measuring_mode = flash_.measuring_mode;
  block.variant = variant_;
  block.restart_mode = flash_.restart;
  block.restart_time = flash_.restart_time;
  block.baud_word = lms::baud_word(baud_);
  block.address = kAddress;
  block.unit = flash_.unit;
  return reply(encode(block, status().raw()));
}

LmsAnswer LmsControl::on(const lms::RequestErrors& /*command*/) {
  std::vector<lms::DeviceError> errors;
  if (faults_.fatal) {
    errors.push_back(kFatalError);
  }
  if (faults_.polluted) {
    errors.push_back(kPollutionWarning);
  }
  return reply(encode(errors, status().raw()));
}

LmsAnswer LmsControl::on(const lms::RequestType& /*command*/) {
  return reply(lms::encode_text(lms::response_code::kType, params_.type, status().raw()));
}

LmsAnswer LmsControl::on(const lms::SetVariant& command) {
  const bool accepted = is_variant(command.variant);
  if (accepted) {
    variant_ = command.variant;
    if (sub_range() && sub_range_.last > variant_.beams()) {
      mode_ = mode_code::kRequest;  // its values are no more
    }
  }
  return reply(encode(lms::VariantReply{accepted, variant_}, status().raw()));
}

LmsAnswer LmsControl::on(const lms::RequestConfig& /*command*/) {
  return reply(lms::encode_config(flash_, status().raw()));
}

LmsAnswer LmsControl::on(const lms::SetConfig& command) {
  if (mode_ != mode_code::kInstallation) {
    return not_accepted();
  }
  const lms::ConfigBlock wanted = overwritten(flash_, command.leading);
  const bool accepted = lms::unit_of(wanted.unit) && lms::measuring_mode_of(wanted.measuring_mode);
  flash_ = accepted ? wanted : flash_;
  LmsAnswer answer = reply(encode(lms::ConfigWrittenReply{accepted, flash_}, status().raw()));
  answer.delay_s = params_.flash_write_s;
  return answer;
}

}  // namespace seeker::emulator
