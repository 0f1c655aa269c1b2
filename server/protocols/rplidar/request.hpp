/// \file
/// What a host asks of an RPLIDAR (protocols 3.1, 3.2).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace seeker::rplidar {

/// First byte of every request.
inline constexpr std::uint8_t kRequestStart = 0xA5;
/// Commands with this bit carry a payload, its size before it and an exclusive or behind it.
inline constexpr std::uint8_t kPayloadBit = 0x80;
/// The longest payload that is taken; every known request has at most 8 bytes.
inline constexpr std::size_t kMaxRequestPayload = 64;

/// Known commands. A request may carry another one: devices ignore it.
enum class Command : std::uint8_t {
  kScan = 0x20,
  kForceScan = 0x21,
  kStop = 0x25,
  kReset = 0x40,
  kGetInfo = 0x50,
  kGetHealth = 0x52,
  kGetSampleRate = 0x59,
  kExpressScan = 0x82,
  kGetConf = 0x84,
  kSetMotorRpm = 0xA8,
  kSetMotorPwm = 0xF0,
  kGetAccBoardFlag = 0xFF,
};

struct Request {
  Command command = Command::kStop;
  std::vector<std::uint8_t> payload;  ///< empty for commands without kPayloadBit

  friend bool operator==(const Request&, const Request&) = default;
};

/// The bytes of a request. A payload goes with a command that has kPayloadBit, of at most kMaxRequestPayload bytes.
[[nodiscard]] std::vector<std::uint8_t> encode(const Request& request);

/// Starts a scan in capsules by the number of its mode; 0 is the one that every firmware with capsules has.
[[nodiscard]] Request express_scan(std::uint8_t mode);
/// Sets the motor's duty, 0 (off) to 1023.
[[nodiscard]] Request set_motor_pwm(std::uint16_t pwm);
/// Asks whether the accessory board can control the motor.
[[nodiscard]] Request get_acc_board_flag();

/// Entries of the configuration (protocols 3.2).
enum class ConfType : std::uint32_t {
  kDesiredSpeed = 0x01,  ///< u16 rpm, u16 pwm
  kModeCount = 0x70,     ///< u16
  kSamplePeriod = 0x71,  ///< of a mode: u32 microseconds with 8 binary digits behind the point
  kMaxDistance = 0x74,   ///< of a mode: u32 metres with 8 binary digits behind the point
  kAnswerType = 0x75,    ///< of a mode: u8 type of its answer
  kTypicalMode = 0x7C,   ///< u16
  kModeName = 0x7F,      ///< of a mode: text that ends with a zero
};

/// Asks for an entry that is not of a mode.
[[nodiscard]] Request get_conf(ConfType type);
/// Asks for an entry of one mode.
[[nodiscard]] Request get_conf(ConfType type, std::uint16_t mode);

}  // namespace seeker::rplidar
