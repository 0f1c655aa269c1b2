/// \file
/// The standard server information packet (SIP), the state that a base sends about every 100 ms (protocols 1.6), in the
/// units of the wire.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/core/result.hpp"
#include "server/protocols/p2os/packet.hpp"

namespace seeker::p2os {

/// Counters of the position wrap at this value.
inline constexpr int kPositionModulus = 0x8000;

/// Bits of Sip::flags.
namespace flag {
inline constexpr std::uint16_t kMotorsOn = 1U << 0U;
inline constexpr std::uint16_t kFrontSonar = 1U << 1U;
inline constexpr std::uint16_t kRearSonar = 1U << 2U;
inline constexpr std::uint16_t kEStop = 1U << 5U;   ///< the button is pressed
inline constexpr std::uint16_t kEStall = 1U << 6U;  ///< the emergency circuit halted the base
inline constexpr std::uint16_t kChargerPower = 1U << 10U;
}  // namespace flag

/// Bits of Sip::stall_left_rear and Sip::stall_right_front: the wheel, and seven bumpers above it.
inline constexpr std::uint8_t kWheelStalled = 0x01;
inline constexpr std::uint8_t kBumpers = 0xFE;

/// Values of Sip::charge_state.
enum class ChargeState : std::uint8_t { kNot = 0, kBulk = 1, kOver = 2, kFloat = 3, kBalance = 4, kUnknown = 0xFF };

/// One new reading of a transducer, in range units of the model.
struct SipSonar {
  std::uint8_t number = 0;
  std::uint16_t range = 0;

  friend bool operator==(const SipSonar&, const SipSonar&) = default;
};

/// The fields in the order of the wire. The optional ones come with newer firmware: where one is missing, all after it
/// are missing as well.
struct Sip {
  bool moving = false;     ///< sent as the packet's number
  std::uint16_t x = 0;     ///< distance units, 15 bits
  std::uint16_t y = 0;     ///< distance units, 15 bits
  std::int16_t theta = 0;  ///< angle units, counter-clockwise
  std::int16_t left_velocity = 0;
  std::int16_t right_velocity = 0;
  std::uint8_t battery_dv = 0;
  std::uint8_t stall_left_rear = 0;    ///< kWheelStalled: left wheel; kBumpers: rear
  std::uint8_t stall_right_front = 0;  ///< kWheelStalled: right wheel; kBumpers: front
  std::int16_t control = 0;            ///< heading set point, angle units
  std::uint16_t flags = 0;
  std::uint8_t compass = 0;  ///< 2 deg
  std::vector<SipSonar> sonars;
  std::optional<std::uint16_t> ports;  ///< state of the gripper and analogue port; a timer with old firmware
  std::optional<std::uint8_t> analog;
  std::optional<std::uint8_t> digital_in;
  std::optional<std::uint8_t> digital_out;
  std::optional<std::uint16_t> battery_x10;         ///< 0.1 V
  std::optional<std::uint8_t> charge_state;         ///< a ChargeState
  std::optional<std::int16_t> rotational_velocity;  ///< 0.1 deg/s, counter-clockwise
  std::optional<std::uint16_t> fault_flags;
  std::optional<std::int16_t> lateral_velocity;  ///< mm/s
  std::optional<std::int8_t> temperature_c;      ///< -128 or -127: no sensor
  std::optional<std::uint8_t> charge_percent;
  std::optional<std::uint32_t> controller_time_us;
  std::optional<std::uint32_t> flags3;

  friend bool operator==(const Sip&, const Sip&) = default;
};

/// Number of sonar readings that fit into a SIP with all its other fields.
inline constexpr std::size_t kMaxSipSonars = 50;

[[nodiscard]] bool is_sip(const Packet& packet);
/// Reads a packet for which is_sip() holds. Fields that are not there in full are missing; bytes after the last known
/// field are ignored. kCorrupt: it ends within the fields that every firmware sends, or within its sonar readings.
[[nodiscard]] Result<Sip> read_sip(const Packet& packet);
/// The packet of a SIP with at most kMaxSipSonars readings, up to its first missing field.
[[nodiscard]] Packet write_sip(const Sip& sip);

}  // namespace seeker::p2os
