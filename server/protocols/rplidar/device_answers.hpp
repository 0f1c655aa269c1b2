/// \file
/// The single answers of an RPLIDAR: what it is, how it fares, how fast it measures (protocols 3.2).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "server/protocols/rplidar/request.hpp"

namespace seeker::rplidar {

inline constexpr std::size_t kInfoBytes = 20;
inline constexpr std::size_t kHealthBytes = 3;
inline constexpr std::size_t kSampleRateBytes = 4;
inline constexpr std::size_t kAccBoardBytes = 4;
inline constexpr std::size_t kConfTypeBytes = 4;
/// The longest answer to a question for the configuration that is taken: the names of modes are shorter.
inline constexpr std::size_t kMaxConfBytes = 128;

/// Version of the firmware as a number that can be compared: 1.24 is {1, 24}.
struct Firmware {
  std::uint8_t major = 0;
  std::uint8_t minor = 0;

  friend auto operator<=>(const Firmware&, const Firmware&) = default;
};

struct DeviceInfo {
  std::uint8_t model = 0;  ///< high half: the series (1 = A1, 2 = A2), low half: the kind within it
  Firmware firmware;
  std::uint8_t hardware = 0;
  std::array<std::uint8_t, 16> serial{};

  /// 1 for an A1, 2 for an A2.
  [[nodiscard]] unsigned series() const { return model >> 4U; }
  friend bool operator==(const DeviceInfo&, const DeviceInfo&) = default;
};

enum class HealthStatus : std::uint8_t { kGood = 0, kWarning = 1, kProtectionStop = 2 };

struct Health {
  HealthStatus status = HealthStatus::kGood;
  std::uint16_t code = 0;  ///< the manufacturer's number of the fault

  friend bool operator==(const Health&, const Health&) = default;
};

/// Microseconds from sample to sample.
struct SampleRate {
  std::uint16_t legacy_us = 0;
  std::uint16_t express_us = 0;

  friend bool operator==(const SampleRate&, const SampleRate&) = default;
};

/// An entry of the configuration.
struct ConfAnswer {
  ConfType type = ConfType::kTypicalMode;
  std::vector<std::uint8_t> data;

  friend bool operator==(const ConfAnswer&, const ConfAnswer&) = default;
};

struct AccBoard {
  bool controls_motor = false;  ///< the motor's duty can be set by request

  friend bool operator==(const AccBoard&, const AccBoard&) = default;
};

/// Descriptor and payload of an answer.
[[nodiscard]] std::vector<std::uint8_t> encode(const DeviceInfo& info);
[[nodiscard]] std::vector<std::uint8_t> encode(const Health& health);
[[nodiscard]] std::vector<std::uint8_t> encode(const SampleRate& rate);
[[nodiscard]] std::vector<std::uint8_t> encode(const ConfAnswer& answer);
[[nodiscard]] std::vector<std::uint8_t> encode(const AccBoard& board);

/// These read the payload behind a descriptor, whole. Nothing: its length or its content is impossible.
[[nodiscard]] std::optional<DeviceInfo> decode_info(std::span<const std::uint8_t> payload);
[[nodiscard]] std::optional<Health> decode_health(std::span<const std::uint8_t> payload);
[[nodiscard]] std::optional<SampleRate> decode_sample_rate(std::span<const std::uint8_t> payload);
[[nodiscard]] std::optional<ConfAnswer> decode_conf(std::span<const std::uint8_t> payload);
[[nodiscard]] std::optional<AccBoard> decode_acc_board(std::span<const std::uint8_t> payload);

}  // namespace seeker::rplidar
