/// \file
/// Commands of a client to the base (protocols 1.4), and their forms on the wire.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/core/result.hpp"
#include "server/protocols/p2os/packet.hpp"

namespace seeker::p2os {

/// Numbers 0 to 2 are SYNC0 to SYNC2 as long as there is no connection, and PULSE, OPEN and CLOSE in one.
enum class CommandId : std::uint8_t {
  kPulse = 0,
  kOpen = 1,
  kClose = 2,
  kEnable = 4,      ///< 1: motors on
  kSetA = 5,        ///< mm/s^2; positive: acceleration, negative: deceleration
  kSetV = 6,        ///< largest velocity, mm/s
  kSetOrigin = 7,   ///< odometry to zero
  kMove = 8,        ///< mm
  kRotate = 9,      ///< deg/s, as kRotVel
  kSetRv = 10,      ///< largest rotational velocity, deg/s
  kVel = 11,        ///< mm/s
  kHead = 12,       ///< deg, absolute
  kDeltaHead = 13,  ///< deg, relative, counter-clockwise
  kConfig = 18,     ///< asks for the packet PacketId::kConfig
  kEncoder = 19,    ///< 0: none, 1: one packet, above: one with each SIP
  kRotVel = 21,     ///< deg/s, counter-clockwise
  kSetRa = 23,      ///< deg/s^2; positive: acceleration, negative: deceleration
  kSonar = 28,      ///< 1: on
  kStop = 29,
  kVel2 = 32,       ///< both wheels, see WheelSpeeds
  kBumpStall = 44,  ///< bumpers that stall the base: 0 none, 1 front, 2 rear, 3 both
  kHostBaud = 50,   ///< see baud_code()
  kEStop = 55,      ///< halts at once, without the deceleration
  kGyro = 58,       ///< 1: one packet PacketId::kGyro with each SIP
};

/// A command as it arrived. The number may be none of CommandId; clients send more than a base needs to know.
struct Command {
  std::uint8_t number = 0;
  std::variant<std::monostate, int, std::string> argument;

  [[nodiscard]] bool is(CommandId id) const { return number == static_cast<std::uint8_t>(id); }
  /// Nothing: it has no argument, or a text.
  [[nodiscard]] std::optional<int> integer() const;
  friend bool operator==(const Command&, const Command&) = default;
};

/// Largest absolute value of an integer argument.
inline constexpr int kMaxArgument = 0xFFFF;

[[nodiscard]] std::vector<std::uint8_t> encode_command(CommandId id);
/// `argument` within +-kMaxArgument; its sign travels in the argument's type.
[[nodiscard]] std::vector<std::uint8_t> encode_command(CommandId id, int argument);
[[nodiscard]] std::vector<std::uint8_t> encode_command(const Command& command);

/// Reads a client's packet. An argument's type without a value is a command without an argument, as Player sends with
/// SETO (protocols 1.3). kParse: the argument's type is unknown, or its text is cut off.
[[nodiscard]] Result<Command> parse_command(const Packet& packet);

/// Velocities of the wheels as VEL2 carries them, in steps of the model's vel2_divisor_mm_s.
struct WheelSpeeds {
  std::int8_t left = 0;
  std::int8_t right = 0;

  friend bool operator==(const WheelSpeeds&, const WheelSpeeds&) = default;
};

/// Argument of VEL2: the low byte is the right wheel. It is signed, as clients send it.
[[nodiscard]] int vel2_argument(const WheelSpeeds& speeds);
/// The speeds in an argument of either sign.
[[nodiscard]] WheelSpeeds vel2_speeds(int argument);

/// Argument of HOSTBAUD for a rate (protocols 1.1). Nothing: the base has no such rate.
[[nodiscard]] std::optional<int> baud_code(std::uint32_t baud);
[[nodiscard]] std::optional<std::uint32_t> baud_of_code(int code);

}  // namespace seeker::p2os
