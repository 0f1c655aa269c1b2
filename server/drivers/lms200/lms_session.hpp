/// \file
/// The talk with a SICK LMS200.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/core/scan.hpp"
#include "server/drivers/link/device_session.hpp"
#include "server/drivers/lms200/byte_arrivals.hpp"
#include "server/drivers/lms200/lms_handshake.hpp"
#include "server/drivers/lms200/lms_health.hpp"
#include "server/drivers/lms200/lms_params.hpp"
#include "server/drivers/lms200/scan_maker.hpp"
#include "server/protocols/lms200/telegram_reader.hpp"

namespace seeker::drivers {

/// Brings the scanner to the wanted rate, variant and output, regardless of what it did before, and turns its telegrams
/// into scans that are stamped with the time at which their middle beam was measured. Damaged telegrams are counted and
/// left out. Without scans for LmsParams::scan_timeout_s the line is given up.
class LmsSession final : public DeviceSession {
 public:
  /// Valid parameters (see validate()).
  explicit LmsSession(const LmsParams& params);

  void open(RobotTime now) override;
  void receive(std::span<const std::uint8_t> bytes, RobotTime now) override;
  void pass(RobotTime now) override;
  [[nodiscard]] RobotTime wake() const override;
  [[nodiscard]] std::vector<LineAction> take_actions() override;
  /// The farewell stops the output and sets the rate at which the scanner was found first.
  void close(RobotTime now) override;

  [[nodiscard]] Status state() const override;
  [[nodiscard]] bool wants_reopen() const override { return failure_.has_value(); }
  [[nodiscard]] LinkStatistics statistics() const override;

  /// The newest scan that was not taken yet. Stamps rise from scan to scan.
  [[nodiscard]] std::optional<LaserScan> take_scan();
  /// What is wrong with a scanner that measures nevertheless, with the remedy: a dirty window, errors that it reports,
  /// another unit than wanted. Nothing: it is well, or gives no scans at all (see state()).
  [[nodiscard]] std::optional<Error> warning() const;

 private:
  enum class Phase : std::uint8_t { kClosed, kHandshake, kStreaming };

  void handle(const lms200::Received& received, RobotTime now);
  void take_telegram(const lms200::Received& received, RobotTime now);
  void take_scan_telegram(const lms200::Received& received, RobotTime now);
  void drain(RobotTime now);
  void advance(RobotTime now);
  void perform_drops();
  void lose(RobotTime now);
  [[nodiscard]] std::string cause_of_silence(RobotTime now) const;

  LmsParams params_;
  LmsHealth health_;
  LmsHandshake handshake_;
  ScanMaker maker_;
  lms200::TelegramReader reader_;
  ByteArrivals arrivals_;
  std::vector<LineAction> actions_;
  Phase phase_ = Phase::kClosed;
  std::optional<Error> failure_;
  RobotTime last_byte_;
  RobotTime last_scan_;  ///< arrival of the newest scan, or the start of the output
  bool scans_come_ = false;
  std::optional<LaserScan> scan_;
  std::optional<RobotTime> last_stamp_;
  LinkStatistics statistics_;    ///< what the reader does not count
  LinkStatistics at_last_scan_;  ///< statistics() when the newest scan came
};

}  // namespace seeker::drivers
