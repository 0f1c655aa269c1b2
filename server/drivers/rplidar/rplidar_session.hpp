/// \file
/// The talk with an RPLIDAR A1 or A2: who it is, how it fares, its motor, and its scan (protocols 3).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/core/scan.hpp"
#include "server/drivers/link/device_session.hpp"
#include "server/drivers/rplidar/enquiry.hpp"
#include "server/drivers/rplidar/rplidar_params.hpp"
#include "server/drivers/rplidar/scan_stream.hpp"
#include "server/protocols/rplidar/answer_reader.hpp"

namespace seeker::drivers {

/// Starts the scanner and turns its stream into scans, one a turn, each with the time that it took (LaserScan::sweep).
/// A scan that falls silent or whose rotor stands is started again; a device that does not answer is given up.
class RplidarSession final : public DeviceSession {
 public:
  /// `params` are valid.
  explicit RplidarSession(const RplidarParams& params);

  void open(RobotTime now) override;
  void receive(std::span<const std::uint8_t> bytes, RobotTime now) override;
  void pass(RobotTime now) override;
  [[nodiscard]] RobotTime wake() const override;
  [[nodiscard]] std::vector<LineAction> take_actions() override;
  void close(RobotTime now) override;
  [[nodiscard]] Status state() const override;
  [[nodiscard]] bool wants_reopen() const override { return step_ == Step::kFailed; }
  [[nodiscard]] LinkStatistics statistics() const override;

  /// The newest turn since the last call. Nothing: there is none.
  [[nodiscard]] std::optional<LaserScan> take_scan();
  /// What the device warns of though it measures. Nothing: it is well.
  [[nodiscard]] std::optional<Error> warning() const { return warning_; }

 private:
  enum class Step : std::uint8_t {
    kClosed,
    kStopping,  // STOP was sent, and what the device still sends is let pass
    kInfo,
    kHealth,
    kBooting,
    kSampleRate,
    kAccBoard,
    kTypicalMode,
    kModeAnswer,
    kModePeriod,
    kStarting,  // the scan was requested, its stream is not announced yet
    kScanning,
    kFailed,
  };
  /// What the device answered about itself since the handshake began.
  struct Findings {
    rplidar::DeviceInfo info;
    rplidar::SampleRate rate;
    bool motor_by_pwm = false;
    bool legacy = false;             ///< samples are sent one by one
    std::uint8_t mode = 0;           ///< of the scan in capsules
    std::uint16_t typical_mode = 0;  ///< by the configuration
    Duration sample_period{};
  };

  void act(LineAction action);
  void send(const rplidar::Request& request);
  /// Puts the question of a step.
  void ask(Step step, const rplidar::Request& request, rplidar::AnswerType answer, RobotTime now);
  /// Puts a question for the configuration of the typical mode.
  void ask_conf(Step step, rplidar::ConfType type, RobotTime now);
  /// Puts the same question once more, or takes it for unanswered.
  void repeat(RobotTime now);
  void stop(RobotTime now);
  void answered(const rplidar::AnswerValue& answer, RobotTime now);
  void unanswered(RobotTime now);

  void learn_info(const rplidar::DeviceInfo& info, RobotTime now);
  void learn_health(const rplidar::Health& health, RobotTime now);
  void learn_rate(const rplidar::SampleRate& rate, RobotTime now);
  /// Returns false for an answer that says what cannot be used.
  [[nodiscard]] bool learn_conf(const rplidar::ConfAnswer& conf, RobotTime now);
  void choose_motor(RobotTime now);
  void choose_mode(RobotTime now);
  void start_scan(RobotTime now);
  void follow_scan(const rplidar::Answer& answer, RobotTime now);
  void try_next_baud(RobotTime now);
  void restart(const std::string& reason, RobotTime now);
  void give_up(Errc code, std::string message);

  RplidarParams params_;
  Step step_ = Step::kClosed;
  Findings found_;
  rplidar::AnswerReader reader_;
  Enquiry enquiry_;
  rplidar::AnswerType expected_ = rplidar::AnswerType::kInfo;
  rplidar::ConfType asked_conf_ = rplidar::ConfType::kTypicalMode;
  ScanStream stream_;
  std::vector<LineAction> actions_;
  RobotTime pause_until_;      ///< end of kStopping and kBooting
  RobotTime last_record_;      ///< newest sample or capsule
  RobotTime last_revolution_;  ///< newest whole turn, or the start of the scan
  std::size_t baud_ = 0;       ///< index of the rate in use
  std::size_t bauds_tried_ = 0;
  bool turning_ = false;  ///< a whole turn has come since the scan was started
  int resets_ = 0;
  int restarts_ = 0;
  std::optional<LaserScan> scan_;
  std::optional<Error> warning_;
  Error failure_;
  LinkStatistics statistics_;
};

}  // namespace seeker::drivers
