/// \file
/// From the handshake to a base that sends and obeys: OPEN, its configuration, the rate of the line, its limits
/// (protocols 1.1, 1.3, 1.7).
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/core/result.hpp"
#include "common/core/time.hpp"
#include "server/drivers/p2os/base_limits.hpp"
#include "server/drivers/p2os/p2os_params.hpp"
#include "server/drivers/p2os/packet_line.hpp"
#include "server/protocols/p2os/config_packet.hpp"
#include "server/protocols/p2os/pioneer_model.hpp"

namespace seeker::drivers {

/// Brings a base that has named itself into service, step by step, and falls back to the rate at which it was found
/// where it is silent at a new one.
class P2osSetup {
 public:
  /// `params` and `line` must outlive it.
  P2osSetup(const P2osParams& params, PacketLine& line) : params_(params), line_(line) {}

  /// Opens the base that answered at this rate.
  void begin(const p2os::PioneerModel& model, std::uint32_t baud, RobotTime now);
  void on_packet(const p2os::Packet& packet, RobotTime now);
  void pass(RobotTime now);
  [[nodiscard]] RobotTime wake() const;

  /// The base sends, and its limits, sonar and gyroscope are set.
  [[nodiscard]] bool done() const { return step_ == Step::kDone; }
  [[nodiscard]] const std::optional<Error>& failure() const { return failure_; }
  [[nodiscard]] std::string progress() const;

  /// Valid once done(): the base's configuration. Nothing: it sent none.
  [[nodiscard]] const std::optional<p2os::ConfigPacket>& config() const { return config_; }
  [[nodiscard]] const BaseLimits& limits() const { return limits_; }
  /// Rate of the line now, and the one at which the base was found.
  [[nodiscard]] std::uint32_t baud() const { return baud_; }
  [[nodiscard]] std::uint32_t first_baud() const { return first_baud_; }

 private:
  enum class Step : std::uint8_t { kIdle, kOpening, kAsking, kSettling, kListening, kFallingBack, kDone };

  void on_opened(RobotTime now);
  void on_config(const p2os::Packet& packet, RobotTime now);
  /// Changes the rate where that is wanted and allowed, and sets the base up.
  void on_configured(RobotTime now);
  /// Asks for a sign of life at the rate of the line.
  void listen(Step step, RobotTime now);
  void set_up();
  void end_with(std::string message);

  const P2osParams& params_;
  PacketLine& line_;
  Step step_ = Step::kIdle;
  RobotTime deadline_ = RobotTime::max();  ///< of this step
  RobotTime ask_again_ = RobotTime::max();
  const p2os::PioneerModel* model_ = nullptr;
  std::uint32_t baud_ = 0;
  std::uint32_t first_baud_ = 0;
  std::optional<p2os::ConfigPacket> config_;
  BaseLimits limits_;
  std::optional<Error> failure_;
};

}  // namespace seeker::drivers
