#include "server/protocols/lms200/responses.hpp"

#include <algorithm>

#include "common/core/assert.hpp"
#include "server/protocols/lms200/little_endian.hpp"
#include "server/protocols/lms200/telegram.hpp"

namespace seeker::lms200 {
namespace {

constexpr std::size_t kCodeAndStatus = 2;

tl::unexpected<Error> wrong_response_length(std::span<const std::uint8_t> payload) {
  return fail(Errc::kParse,
              "a response of " + std::to_string(payload.size()) + " bytes has not the length of its kind");
}

/// What lies between the code, `skipped` bytes and the status byte.
std::span<const std::uint8_t> content_of(std::span<const std::uint8_t> payload, std::size_t skipped = 0) {
  return payload.subspan(1 + skipped, payload.size() - kCodeAndStatus - skipped);
}

char printable(std::uint8_t byte) { return byte >= 0x20 && byte < 0x7F ? static_cast<char>(byte) : '?'; }

}  // namespace

std::vector<std::uint8_t> encode_plain(std::uint8_t code, std::uint8_t status) { return {code, status}; }

std::vector<std::uint8_t> encode(ModeResult result, std::uint8_t status) {
  return {response_code::kMode, static_cast<std::uint8_t>(result), status};
}

std::vector<std::uint8_t> encode(const VariantReply& reply, std::uint8_t status) {
  std::vector<std::uint8_t> bytes{response_code::kVariant, reply.accepted ? std::uint8_t{1} : std::uint8_t{0}};
  append_u16(bytes, reply.variant.angle_deg);
  append_u16(bytes, reply.variant.resolution_cdeg);
  bytes.push_back(status);
  return bytes;
}

std::vector<std::uint8_t> encode_config(const ConfigBlock& config, std::uint8_t status) {
  std::vector<std::uint8_t> bytes{response_code::kConfig};
  const auto block = encode(config);
  bytes.insert(bytes.end(), block.begin(), block.end());
  bytes.push_back(status);
  return bytes;
}

std::vector<std::uint8_t> encode(const ConfigWrittenReply& reply, std::uint8_t status) {
  std::vector<std::uint8_t> bytes{response_code::kConfigWritten, reply.accepted ? std::uint8_t{1} : std::uint8_t{0}};
  const auto block = encode(reply.config);
  bytes.insert(bytes.end(), block.begin(), block.end());
  bytes.push_back(status);
  return bytes;
}

std::vector<std::uint8_t> encode(std::span<const DeviceError> errors, std::uint8_t status) {
  SEEKER_ASSERT(errors.size() <= kMaxDeviceErrors);
  std::vector<std::uint8_t> bytes{response_code::kErrors};
  bytes.reserve(kCodeAndStatus + 2 * errors.size());
  for (const DeviceError& error : errors) {
    bytes.push_back(error.type);
    bytes.push_back(error.number);
  }
  bytes.push_back(status);
  return bytes;
}

std::vector<std::uint8_t> encode_text(std::uint8_t code, const std::string& text, std::uint8_t status) {
  const std::size_t length = std::min(text.size(), kMaxPayloadBytes - kCodeAndStatus);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(kCodeAndStatus + length);
  bytes.push_back(code);
  bytes.insert(bytes.end(), text.begin(), text.begin() + static_cast<std::ptrdiff_t>(length));
  bytes.push_back(status);
  return bytes;
}

Result<ModeResult> decode_mode_result(std::span<const std::uint8_t> payload) {
  if (payload.size() != kCodeAndStatus + 1) {
    return wrong_response_length(payload);
  }
  if (payload[1] > static_cast<std::uint8_t>(ModeResult::kFault)) {
    return fail(Errc::kParse, "a change of mode has the unknown result " + std::to_string(payload[1]));
  }
  return static_cast<ModeResult>(payload[1]);
}

Result<VariantReply> decode_variant(std::span<const std::uint8_t> payload) {
  constexpr std::size_t kContent = 5;
  if (payload.size() != kCodeAndStatus + kContent) {
    return wrong_response_length(payload);
  }
  return VariantReply{payload[1] == 1, {u16_at(payload, 2), u16_at(payload, 4)}};
}

Result<ConfigBlock> decode_config_reply(std::span<const std::uint8_t> payload) {
  if (payload.size() != kCodeAndStatus + ConfigBlock::kBytes) {
    return wrong_response_length(payload);
  }
  return decode_config(content_of(payload).first<ConfigBlock::kBytes>());
}

Result<ConfigWrittenReply> decode_config_written(std::span<const std::uint8_t> payload) {
  if (payload.size() != kCodeAndStatus + 1 + ConfigBlock::kBytes) {
    return wrong_response_length(payload);
  }
  return ConfigWrittenReply{payload[1] == 1, decode_config(content_of(payload, 1).first<ConfigBlock::kBytes>())};
}

Result<std::vector<DeviceError>> decode_errors(std::span<const std::uint8_t> payload) {
  if (payload.size() < kCodeAndStatus || payload.size() % 2 != 0) {
    return wrong_response_length(payload);
  }
  const std::span<const std::uint8_t> content = content_of(payload);
  std::vector<DeviceError> errors;
  errors.reserve(content.size() / 2);
  for (std::size_t at = 0; at + 1 < content.size(); at += 2) {
    errors.push_back({content[at], content[at + 1]});
  }
  return errors;
}

Result<std::string> decode_text(std::span<const std::uint8_t> payload) {
  if (payload.size() < kCodeAndStatus) {
    return wrong_response_length(payload);
  }
  const std::span<const std::uint8_t> content = content_of(payload);
  std::string text(content.size(), ' ');
  std::transform(content.begin(), content.end(), text.begin(), printable);
  return text;
}

}  // namespace seeker::lms200
