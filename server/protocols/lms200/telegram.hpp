/// \file
/// The frame of telegrams of the SICK LMS200 (protocols 2.2).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/core/result.hpp"
#include "common/core/time.hpp"

namespace seeker::lms200 {

inline constexpr std::uint8_t kStx = 0x02;
inline constexpr std::uint8_t kAckByte = 0x06;  ///< sent alone by the device: the telegram came whole
inline constexpr std::uint8_t kNakByte = 0x15;  ///< sent alone by the device: the telegram came damaged
inline constexpr std::uint8_t kHostAddress = 0x00;
inline constexpr std::uint8_t kDeviceAddress = 0x80;
inline constexpr std::uint8_t kLastDeviceAddress = 0x84;
inline constexpr std::size_t kHeaderBytes = 4;
inline constexpr std::size_t kCrcBytes = 2;
inline constexpr std::size_t kMaxPayloadBytes = 812;
inline constexpr std::size_t kMaxTelegramBytes = kHeaderBytes + kMaxPayloadBytes + kCrcBytes;
/// One start bit, eight data bits, one stop bit (8N1).
inline constexpr double kBitsPerByte = 10.0;

enum class Sender : std::uint8_t { kHost, kDevice };

/// Time that `bytes` bytes need on a line of `baud` bits per second, above 0.
[[nodiscard]] Duration transfer_time(std::size_t bytes, std::uint32_t baud);

/// The telegram with this payload, which has 1 to kMaxPayloadBytes bytes: command and data of the host, or response,
/// data and status byte of the device.
[[nodiscard]] std::vector<std::uint8_t> encode_telegram(Sender sender, std::span<const std::uint8_t> payload);

/// The device's last byte of each payload: how it fares. In good operation it is 0x10.
class StatusByte {
 public:
  enum class Level : std::uint8_t { kNone = 0, kInfo = 1, kWarning = 2, kError = 3, kFatal = 4 };
  static constexpr std::uint8_t kGood = 0x10;

  StatusByte() = default;
  explicit StatusByte(std::uint8_t raw) : raw_(raw) {}
  [[nodiscard]] static StatusByte of(Level level, bool polluted);

  [[nodiscard]] std::uint8_t raw() const { return raw_; }
  /// The worst of what the device reports; levels above fatal, which are not in use, are fatal.
  [[nodiscard]] Level level() const;
  /// The front window is dirty.
  [[nodiscard]] bool polluted() const { return (raw_ & kPollutionBit) != 0; }

  friend bool operator==(const StatusByte&, const StatusByte&) = default;

 private:
  static constexpr std::uint8_t kLevelMask = 0x07;
  static constexpr std::uint8_t kPollutionBit = 0x80;

  std::uint8_t raw_ = kGood;
};

}  // namespace seeker::lms200
