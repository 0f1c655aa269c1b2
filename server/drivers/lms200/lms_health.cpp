#include "server/drivers/lms200/lms_health.hpp"

#include <algorithm>

namespace seeker::drivers {
namespace {

/// More would make the sentence unreadable.
constexpr std::size_t kListedErrors = 5;

}  // namespace

void LmsHealth::note_config(const lms200::ConfigBlock& config) {
  other_config_.reset();
  const auto unit = static_cast<std::uint8_t>(params_.unit);
  const auto mode = static_cast<std::uint8_t>(params_.measuring_mode);
  if (config.unit == unit && config.measuring_mode == mode) {
    return;
  }
  const std::optional<lms200::Unit> its_unit = lms200::unit_of(config.unit);
  other_config_ =
      Error{Errc::kRefused, "the laser scanner measures in " + (its_unit ? to_string(*its_unit) : "an unknown unit") +
                                " and mode " + std::to_string(config.measuring_mode) + " instead of " +
                                to_string(params_.unit) + " and mode " + std::to_string(mode) +
                                "; allow may_write_flash once, or change the settings to its own"};
}

void LmsHealth::restart() {
  status_ = {};
  errors_.clear();
  other_config_.reset();
}

std::string LmsHealth::listed_errors() const {
  std::string text;
  for (std::size_t i = 0; i < std::min(errors_.size(), kListedErrors); ++i) {
    text += (i == 0 ? " (type " : ", type ") + std::to_string(errors_[i].type) + " number " +
            std::to_string(errors_[i].number);
  }
  return text.empty() ? text : text + ")";
}

std::optional<Error> LmsHealth::warning() const {
  using Level = lms200::StatusByte::Level;
  if (fatal()) {
    return Error{Errc::kInternal, "the laser scanner reports a fatal error" + listed_errors() +
                                      "; switch it off and on, and have it serviced if the error returns"};
  }
  if (status_.level() == Level::kError) {
    return Error{Errc::kInternal, "the laser scanner reports an error" + listed_errors() +
                                      "; its ranges may be wrong: switch it off and on"};
  }
  if (status_.polluted()) {
    return Error{
        Errc::kInternal,
        "the front window of the laser scanner is dirty, so that it sees less far; clean it with a soft cloth"};
  }
  if (status_.level() == Level::kWarning) {
    return Error{Errc::kInternal, "the laser scanner warns of its own state" + listed_errors() +
                                      "; check its window and its supply voltage"};
  }
  return other_config_;
}

}  // namespace seeker::drivers
