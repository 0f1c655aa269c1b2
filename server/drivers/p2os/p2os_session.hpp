/// \file
/// The talk with a Pioneer base over P2OS/ARCOS (protocols 1).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/core/pose2.hpp"
#include "common/core/scan.hpp"
#include "server/drivers/interfaces/drivers.hpp"
#include "server/drivers/link/device_session.hpp"
#include "server/drivers/p2os/base_condition.hpp"
#include "server/drivers/p2os/base_odometry.hpp"
#include "server/drivers/p2os/motion_commands.hpp"
#include "server/drivers/p2os/motor_switch.hpp"
#include "server/drivers/p2os/p2os_handshake.hpp"
#include "server/drivers/p2os/p2os_params.hpp"
#include "server/drivers/p2os/p2os_setup.hpp"
#include "server/drivers/p2os/packet_line.hpp"
#include "server/drivers/p2os/sonar_ring.hpp"

namespace seeker::drivers {

/// One base. A pressed bumper, a stalled wheel, the emergency stop and the charger halt it in the call that brings the
/// news, and it stays halted towards the obstacle regardless of what is commanded. Without a newer velocity for
/// command_timeout it is stopped; without a living control loop it gets no PULSE, so that its own watchdog halts it.
class P2osSession final : public DeviceSession {
 public:
  /// `params` are valid, see validate().
  explicit P2osSession(P2osParams params);

  void open(RobotTime now) override;
  void receive(std::span<const std::uint8_t> bytes, RobotTime now) override;
  void pass(RobotTime now) override;
  [[nodiscard]] RobotTime wake() const override;
  [[nodiscard]] std::vector<LineAction> take_actions() override { return line_.take_actions(); }
  /// Nothing more is sent, nor kept to be sent, until open().
  void line_lost() override;
  /// Stops the base, switches its motors and sonar off, takes the line back to the rate at which the base was found,
  /// and closes the connection.
  void close(RobotTime now) override;

  [[nodiscard]] Status state() const override;
  [[nodiscard]] bool wants_reopen() const override { return failure_.has_value(); }
  [[nodiscard]] LinkStatistics statistics() const override;

  /// Holds a finite velocity within the limits of the base for command_timeout at most. It is dropped while there is no
  /// connection: nothing moves when a connection comes about.
  void set_velocity(const Twist2& velocity, RobotTime now);
  /// Switches the motors on or off, also after each later connection. Before they go off the base is stopped.
  void set_motors(bool enabled, RobotTime now);
  /// The control loop runs: called whenever it reads, much more often than pulse_period.
  void loop_alive(RobotTime now);

  /// The newest sample since the last call. Its pose goes on over connections.
  /// After another connection it goes on where the base is most likely found (halfway_unseen()).
  [[nodiscard]] std::optional<OdometrySample> take_odometry();
  /// The ring with the newest reading of each transducer, if one is new since the last call.
  [[nodiscard]] std::optional<SonarScan> take_sonar() { return sonar_.take(); }
  /// What keeps the connected base from moving (bumper, stall, emergency stop, motors off, charger), and the remedy.
  [[nodiscard]] std::optional<Error> base_fault() const;

  /// How the base named itself in the last handshake. Nothing: none was completed.
  [[nodiscard]] const std::optional<p2os::Identity>& identity() const { return handshake_.identity(); }
  /// Steps of the odometry that were dropped as impossible, since the first connection.
  [[nodiscard]] std::uint64_t dropped_steps() const { return odometry_.dropped_steps(); }

 private:
  enum class Phase : std::uint8_t { kClosed, kHandshake, kSetup, kRunning };

  void handle_packets(RobotTime now);
  void handle(const p2os::Packet& packet, RobotTime now);
  void on_identity(RobotTime now);
  void begin_running(RobotTime now);
  void on_information(const p2os::Packet& packet, RobotTime now);
  void note_unseen_motion(RobotTime now);
  void on_gyro(const p2os::Packet& packet);
  void keep_sample(const p2os::Sip& sip, RobotTime stamp);
  /// When the base began to send what has arrived in full now.
  [[nodiscard]] RobotTime sent_at(const p2os::Packet& packet, RobotTime now) const;
  /// Serves the timers of the phase and sends what is due.
  void serve(RobotTime now);
  void lose(Error why);

  const P2osParams params_;
  PacketLine line_;
  P2osHandshake handshake_;
  P2osSetup setup_;
  BaseOdometry odometry_;
  SonarRing sonar_;
  BaseCondition condition_;
  MotorSwitch motors_;
  MotionCommands motion_;

  Phase phase_ = Phase::kClosed;
  std::optional<Error> failure_;
  const p2os::PioneerModel* model_ = nullptr;
  RobotTime last_information_;
  Twist2 driving_;  ///< what was commanded when the last information came
  RobotTime last_pulse_ = RobotTime::min();
  Duration pulse_period_{0};
  RobotTime last_stamp_ = RobotTime::min();
  std::optional<OdometrySample> sample_;
  std::optional<RobotTime> unheard_since_;  ///< there was a connection before, and no sample since
  std::uint64_t connects_ = 0;
};

}  // namespace seeker::drivers
