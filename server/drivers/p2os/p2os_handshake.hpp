/// \file
/// The handshake with a base up to the answer in which it names itself (protocols 1.3), with the search for the rate of
/// a serial line.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/core/result.hpp"
#include "common/core/time.hpp"
#include "server/drivers/p2os/p2os_params.hpp"
#include "server/drivers/p2os/packet_line.hpp"
#include "server/protocols/p2os/identity.hpp"

namespace seeker::drivers {

/// SYNC0, SYNC1, SYNC2 at each rate in turn until the base answers. A base that still sends in a connection of before
/// is closed first, and any answer out of turn begins the handshake again after a pause.
class P2osHandshake {
 public:
  /// `params` and `line` must outlive it.
  P2osHandshake(const P2osParams& params, PacketLine& line) : params_(params), line_(line) {}

  /// Begins at the rate at which the base was met last, if any.
  void begin(RobotTime now);
  void on_packet(const p2os::Packet& packet, RobotTime now);
  void pass(RobotTime now);
  [[nodiscard]] RobotTime wake() const { return deadline_; }

  /// How the base named itself. Nothing: the handshake goes on, or has failed.
  [[nodiscard]] const std::optional<p2os::Identity>& identity() const { return identity_; }
  /// Why the base cannot be reached; empty while the handshake goes on.
  [[nodiscard]] const std::optional<Error>& failure() const { return failure_; }
  /// What is being done now, for people.
  [[nodiscard]] std::string progress() const;

  /// Rate of the line now; 0: it has none.
  [[nodiscard]] std::uint32_t baud() const { return baud_; }
  /// The line was set to another rate after the handshake.
  void note_baud(std::uint32_t baud) { baud_ = baud; }

 private:
  enum class Step : std::uint8_t { kSync0, kSync1, kSync2, kPause, kEnd };

  void send_sync(Step step, RobotTime now);
  /// Waits before SYNC0; what arrives meanwhile is dropped.
  void pause(Duration duration, RobotTime now);
  /// Sends CLOSE to a base that is in a connection, and waits for it to end.
  void close_old_connection(RobotTime now);
  void on_stream(RobotTime now);
  void on_identity(const p2os::Packet& packet, RobotTime now);
  /// One more try at this rate is over.
  void try_again(Duration pause_before, RobotTime now);
  void next_rate(RobotTime now);
  void use_rate(std::size_t rate);
  void end_with(Errc code, std::string message);
  [[nodiscard]] std::string silence() const;

  const P2osParams& params_;
  PacketLine& line_;
  Step step_ = Step::kEnd;
  RobotTime deadline_ = RobotTime::max();
  std::vector<std::uint32_t> rates_;
  std::size_t rate_ = 0;
  std::uint32_t baud_ = 0;
  int tries_ = 0;              ///< at this rate
  int closes_ = 0;             ///< of connections of before
  bool search_again_ = false;  ///< a closed connection may have changed the base's rate
  std::uint64_t bytes_before_ = 0;
  std::optional<p2os::Identity> identity_;
  std::optional<Error> failure_;
};

}  // namespace seeker::drivers
