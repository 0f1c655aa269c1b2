/// \file
/// What is wrong with an LMS200 that measures nevertheless.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/core/result.hpp"
#include "server/drivers/lms200/lms_params.hpp"
#include "server/protocols/lms200/config_block.hpp"
#include "server/protocols/lms200/responses.hpp"
#include "server/protocols/lms200/telegram.hpp"

namespace seeker::drivers {

/// Gathers the device's reports on itself.
class LmsHealth {
 public:
  explicit LmsHealth(const LmsParams& params) : params_(params) {}

  /// The status byte of any response.
  void note(lms200::StatusByte status) { status_ = status; }
  void note_errors(std::vector<lms200::DeviceError> errors) { errors_ = std::move(errors); }
  /// The configuration that the device measures with.
  void note_config(const lms200::ConfigBlock& config);
  void restart();

  /// Ranges of a device with a fatal error mean nothing.
  [[nodiscard]] bool fatal() const { return status_.level() == lms200::StatusByte::Level::kFatal; }
  /// The worst of all, with its remedy. Nothing: the device is well.
  [[nodiscard]] std::optional<Error> warning() const;

 private:
  [[nodiscard]] std::string listed_errors() const;

  LmsParams params_;
  lms200::StatusByte status_;
  std::vector<lms200::DeviceError> errors_;
  std::optional<Error> other_config_;
};

}  // namespace seeker::drivers
