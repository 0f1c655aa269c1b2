/// \file
/// What the LMS200 answers (protocols 2.3), as values. Scans and the status block have files of their own.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/core/result.hpp"
#include "server/protocols/lms200/config_block.hpp"
#include "server/protocols/lms200/measuring.hpp"

namespace seeker::lms200 {

namespace command_code {
inline constexpr std::uint8_t kReset = 0x10;
inline constexpr std::uint8_t kMode = 0x20;
inline constexpr std::uint8_t kValues = 0x30;
inline constexpr std::uint8_t kStatus = 0x31;
inline constexpr std::uint8_t kErrors = 0x32;
inline constexpr std::uint8_t kType = 0x3A;
inline constexpr std::uint8_t kVariant = 0x3B;
inline constexpr std::uint8_t kGetConfig = 0x74;
inline constexpr std::uint8_t kSetConfig = 0x77;
}  // namespace command_code

/// Most are the command's code plus 0x80.
namespace response_code {
inline constexpr std::uint8_t kPowerOn = 0x90;  ///< sent unasked after power on
inline constexpr std::uint8_t kReset = 0x91;
inline constexpr std::uint8_t kNotAccepted = 0x92;  ///< the command is unknown, or not allowed in this mode
inline constexpr std::uint8_t kMode = 0xA0;
inline constexpr std::uint8_t kValues = 0xB0;
inline constexpr std::uint8_t kStatus = 0xB1;
inline constexpr std::uint8_t kErrors = 0xB2;
inline constexpr std::uint8_t kSubRange = 0xB7;
inline constexpr std::uint8_t kType = 0xBA;
inline constexpr std::uint8_t kVariant = 0xBB;
inline constexpr std::uint8_t kConfig = 0xF4;
inline constexpr std::uint8_t kConfigWritten = 0xF7;
}  // namespace response_code

/// Result of a change of mode.
enum class ModeResult : std::uint8_t { kDone = 0, kRefused = 1, kFault = 2 };

struct VariantReply {
  bool accepted = false;
  Variant variant;

  friend bool operator==(const VariantReply&, const VariantReply&) = default;
};

struct ConfigWrittenReply {
  bool accepted = false;
  ConfigBlock config;

  friend bool operator==(const ConfigWrittenReply&, const ConfigWrittenReply&) = default;
};

/// One entry of the device's list of errors.
struct DeviceError {
  std::uint8_t type = 0;  ///< as StatusByte::Level
  std::uint8_t number = 0;

  friend bool operator==(const DeviceError&, const DeviceError&) = default;
};
/// The longest list that a telegram holds.
inline constexpr std::size_t kMaxDeviceErrors = 405;

/// Payloads from the response byte to the status byte, which is given.
[[nodiscard]] std::vector<std::uint8_t> encode_plain(std::uint8_t code, std::uint8_t status);
[[nodiscard]] std::vector<std::uint8_t> encode(ModeResult result, std::uint8_t status);
[[nodiscard]] std::vector<std::uint8_t> encode(const VariantReply& reply, std::uint8_t status);
[[nodiscard]] std::vector<std::uint8_t> encode_config(const ConfigBlock& config, std::uint8_t status);
[[nodiscard]] std::vector<std::uint8_t> encode(const ConfigWrittenReply& reply, std::uint8_t status);
[[nodiscard]] std::vector<std::uint8_t> encode(std::span<const DeviceError> errors, std::uint8_t status);
/// `code` is kPowerOn or kType; text beyond what a telegram holds is cut.
[[nodiscard]] std::vector<std::uint8_t> encode_text(std::uint8_t code, const std::string& text, std::uint8_t status);

/// Readers of payloads whose code the caller has looked at. kParse: the length is not that of the response, or a value
/// has no meaning.
[[nodiscard]] Result<ModeResult> decode_mode_result(std::span<const std::uint8_t> payload);
[[nodiscard]] Result<VariantReply> decode_variant(std::span<const std::uint8_t> payload);
[[nodiscard]] Result<ConfigBlock> decode_config_reply(std::span<const std::uint8_t> payload);
[[nodiscard]] Result<ConfigWrittenReply> decode_config_written(std::span<const std::uint8_t> payload);
[[nodiscard]] Result<std::vector<DeviceError>> decode_errors(std::span<const std::uint8_t> payload);
/// Text of a response kPowerOn or kType; what cannot be printed becomes '?'.
[[nodiscard]] Result<std::string> decode_text(std::span<const std::uint8_t> payload);

}  // namespace seeker::lms200
