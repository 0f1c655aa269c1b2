/// \file
/// From an open line to an LMS200 that sends scans.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/core/result.hpp"
#include "common/core/time.hpp"
#include "server/drivers/link/device_session.hpp"
#include "server/drivers/lms200/lms_health.hpp"
#include "server/drivers/lms200/lms_params.hpp"
#include "server/protocols/lms200/commands.hpp"
#include "server/protocols/lms200/config_block.hpp"

namespace seeker::drivers {

/// Sends one command after the other, each again if it is refused, damaged or not answered, up to a bound (protocols
/// 2.4): request mode at each rate until the device answers, the wanted rate, type, status, variant, configuration,
/// output. Without an answer the search for the rate begins again, because the device may have been switched off.
class LmsHandshake {
 public:
  /// `health` outlives the handshake and is given the device's reports.
  LmsHandshake(const LmsParams& params, LmsHealth& health);

  void begin(RobotTime now);
  /// A telegram of the device.
  void answer(std::span<const std::uint8_t> payload, RobotTime now);
  /// The device found the last telegram damaged.
  void refused_damaged(RobotTime now);
  void pass(RobotTime now);
  [[nodiscard]] RobotTime wake() const;
  /// Takes what is to be done to the line, in order.
  [[nodiscard]] std::vector<LineAction> take_actions();

  /// Scans come from now on.
  [[nodiscard]] bool done() const { return step_ == Step::kDone; }
  /// Why the device cannot be used. Nothing: it goes on.
  [[nodiscard]] const std::optional<Error>& failure() const { return failure_; }
  /// kNotReady, with what is being done.
  [[nodiscard]] Error progress() const;
  /// The rate of the line now.
  [[nodiscard]] std::uint32_t baud() const { return baud_; }
  /// The rate at which the device was found first, over all handshakes. Nothing: it never was.
  [[nodiscard]] std::optional<std::uint32_t> original_baud() const { return original_baud_; }
  /// Whether the device has answered at baud() in this handshake.
  [[nodiscard]] bool found() const { return step_ != Step::kSearch; }
  /// Configuration that the device measures with, once done().
  [[nodiscard]] const lms200::ConfigBlock& config() const { return config_; }

 private:
  enum class Step : std::uint8_t {
    kSearch,
    kSetBaud,
    kConfirmBaud,
    kType,
    kStatus,
    kErrors,
    kVariant,
    kReadConfig,
    kInstallation,
    kWriteConfig,
    kOutput,
    kDone
  };
  struct Work {
    lms200::Command command;
    std::uint8_t response = 0;  ///< code of the answer
    double timeout_s = 0.0;
    const char* text = "";  ///< what is being done, after "the laser scanner does not answer to "
  };

  [[nodiscard]] Work work_of(Step step) const;
  void enter(Step step, RobotTime now, double pause_s = 0.0);
  void send(RobotTime now);
  void change_rate(std::uint32_t baud);
  void search_next(RobotTime now);
  void unanswered(RobotTime now);
  void end_round(RobotTime now);
  void rejected(const std::string& reason, RobotTime now);
  void fail_with(Errc code, std::string message);
  [[nodiscard]] Status accept(std::span<const std::uint8_t> payload, RobotTime now);
  [[nodiscard]] Status accept_mode(std::span<const std::uint8_t> payload, RobotTime now);
  [[nodiscard]] Status accept_type(std::span<const std::uint8_t> payload, RobotTime now);
  [[nodiscard]] Status accept_status(std::span<const std::uint8_t> payload, RobotTime now);
  [[nodiscard]] Status accept_errors(std::span<const std::uint8_t> payload, RobotTime now);
  [[nodiscard]] Status accept_variant(std::span<const std::uint8_t> payload, RobotTime now);
  [[nodiscard]] Status accept_config(std::span<const std::uint8_t> payload, RobotTime now);
  [[nodiscard]] Status accept_written(std::span<const std::uint8_t> payload, RobotTime now);
  void use_config(RobotTime now);
  [[nodiscard]] lms200::ConfigBlock wanted_config() const;
  [[nodiscard]] double longest_telegram_s() const;

  LmsParams params_;
  LmsHealth& health_;
  std::vector<std::uint32_t> rates_;  ///< where the device is looked for, in this order
  std::vector<LineAction> actions_;
  Step step_ = Step::kSearch;
  std::size_t rate_ = 0;  ///< index in rates_ while searching
  int rounds_ = 0;
  int tries_ = 0;
  std::optional<RobotTime> send_at_;   ///< the step's command is sent then
  std::optional<RobotTime> deadline_;  ///< of its answer
  std::uint32_t baud_ = 0;
  std::optional<std::uint32_t> original_baud_;
  lms200::ConfigBlock config_;
  std::optional<Error> failure_;
};

}  // namespace seeker::drivers
