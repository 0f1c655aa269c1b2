/// \file
/// The seven bytes that announce each answer of an RPLIDAR (protocols 3.1).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace seeker::rplidar {

inline constexpr std::size_t kDescriptorBytes = 7;
inline constexpr std::uint8_t kDescriptorStart1 = 0xA5;
inline constexpr std::uint8_t kDescriptorStart2 = 0x5A;
/// The length field has 30 bits.
inline constexpr std::uint32_t kMaxAnswerLength = 0x3FFFFFFF;

/// Types of answers.
enum class AnswerType : std::uint8_t {
  kInfo = 0x04,
  kHealth = 0x06,
  kSampleRate = 0x15,
  kConf = 0x20,
  kLegacyScan = 0x81,
  kExpressScan = 0x82,
  kAccBoard = 0xFF,
};

struct Descriptor {
  std::uint32_t length = 0;  ///< bytes of the answer, or of each record of a stream
  bool stream = false;       ///< records follow until another request comes
  AnswerType type = AnswerType::kInfo;

  friend bool operator==(const Descriptor&, const Descriptor&) = default;
};

/// The bytes of a descriptor; its length is at most kMaxAnswerLength.
[[nodiscard]] std::array<std::uint8_t, kDescriptorBytes> encode(const Descriptor& descriptor);
/// The descriptor in the first seven bytes. Nothing: they are none.
[[nodiscard]] std::optional<Descriptor> decode_descriptor(std::span<const std::uint8_t> bytes);

}  // namespace seeker::rplidar
