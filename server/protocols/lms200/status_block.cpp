#include "server/protocols/lms200/status_block.hpp"

#include <algorithm>

#include "server/protocols/lms200/little_endian.hpp"
#include "server/protocols/lms200/responses.hpp"

namespace seeker::lms200 {
namespace {

/// Index of each field from the response byte (protocols 2.5).
constexpr std::size_t kSoftwareVersionAt = 1;
constexpr std::size_t kOperatingModeAt = 8;
constexpr std::size_t kDefectAt = 9;
constexpr std::size_t kVariantCodeAt = 18;
constexpr std::size_t kPollutionAt = 19;
constexpr std::size_t kReferenceAt = 35;
constexpr std::size_t kPollutionCalibrationAt = 43;
constexpr std::size_t kReferenceCalibrationAt = 59;
constexpr std::size_t kRotationsAt = 67;
constexpr std::size_t kMeasuringModeAt = 102;
constexpr std::size_t kAngleAt = 107;
constexpr std::size_t kResolutionAt = 109;
constexpr std::size_t kRestartModeAt = 111;
constexpr std::size_t kRestartTimeAt = 112;
constexpr std::size_t kBaudAt = 116;
constexpr std::size_t kPermanentBaudAt = 119;
constexpr std::size_t kAddressAt = 120;
constexpr std::size_t kFieldSetAt = 121;
constexpr std::size_t kUnitAt = 122;
constexpr std::size_t kLaserOnAt = 123;
constexpr std::size_t kPromVersionAt = 124;
constexpr std::size_t kUsedBytes = kPromVersionAt + StatusBlock::kVersionChars;
constexpr std::size_t kPayloadBytes = 152;

void put_text(std::span<std::uint8_t> bytes, std::size_t at, const std::string& text) {
  for (std::size_t i = 0; i < StatusBlock::kVersionChars; ++i) {
    bytes[at + i] = i < text.size() ? static_cast<std::uint8_t>(text[i]) : std::uint8_t{' '};
  }
}

std::string text_at(std::span<const std::uint8_t> bytes, std::size_t at) {
  const std::span<const std::uint8_t> text = bytes.subspan(at, StatusBlock::kVersionChars);
  return {text.begin(), text.end()};
}

template <std::size_t N>
void put_words(std::span<std::uint8_t> bytes, std::size_t at, const std::array<std::uint16_t, N>& words) {
  for (std::size_t i = 0; i < N; ++i) {
    put_u16(bytes, at + 2 * i, words.at(i));
  }
}

template <std::size_t N>
void read_words(std::span<const std::uint8_t> bytes, std::size_t at, std::array<std::uint16_t, N>& words) {
  for (std::size_t i = 0; i < N; ++i) {
    words.at(i) = u16_at(bytes, at + 2 * i);
  }
}

}  // namespace

std::vector<std::uint8_t> encode(const StatusBlock& block, std::uint8_t status) {
  std::vector<std::uint8_t> bytes(kPayloadBytes, 0);
  bytes.front() = response_code::kStatus;
  put_text(bytes, kSoftwareVersionAt, block.software_version);
  bytes[kOperatingModeAt] = block.operating_mode;
  bytes[kDefectAt] = block.defective ? 1 : 0;
  bytes[kVariantCodeAt] = block.variant_code;
  put_words(bytes, kPollutionAt, block.pollution);
  put_words(bytes, kReferenceAt, block.reference_pollution);
  put_words(bytes, kPollutionCalibrationAt, block.pollution_calibration);
  put_words(bytes, kReferenceCalibrationAt, block.reference_calibration);
  put_u16(bytes, kRotationsAt, block.mirror_rotations);
  bytes[kMeasuringModeAt] = block.measuring_mode;
  put_u16(bytes, kAngleAt, block.variant.angle_deg);
  put_u16(bytes, kResolutionAt, block.variant.resolution_cdeg);
  bytes[kRestartModeAt] = block.restart_mode;
  put_u16(bytes, kRestartTimeAt, block.restart_time);
  put_u16(bytes, kBaudAt, block.baud_word);
  bytes[kPermanentBaudAt] = block.permanent_baud ? 1 : 0;
  bytes[kAddressAt] = block.address;
  bytes[kFieldSetAt] = block.field_set;
  bytes[kUnitAt] = block.unit;
  bytes[kLaserOnAt] = block.laser_on ? 1 : 0;
  put_text(bytes, kPromVersionAt, block.prom_version);
  bytes.back() = status;
  return bytes;
}

Result<StatusBlock> decode_status_block(std::span<const std::uint8_t> payload) {
  if (payload.size() < kUsedBytes + 1) {
    return fail(Errc::kParse, "a status report of " + std::to_string(payload.size()) + " bytes ends before its " +
                                  std::to_string(kUsedBytes) + " bytes of known fields");
  }
  StatusBlock block;
  block.software_version = text_at(payload, kSoftwareVersionAt);
  block.operating_mode = payload[kOperatingModeAt];
  block.defective = payload[kDefectAt] != 0;
  block.variant_code = payload[kVariantCodeAt];
  read_words(payload, kPollutionAt, block.pollution);
  read_words(payload, kReferenceAt, block.reference_pollution);
  read_words(payload, kPollutionCalibrationAt, block.pollution_calibration);
  read_words(payload, kReferenceCalibrationAt, block.reference_calibration);
  block.mirror_rotations = u16_at(payload, kRotationsAt);
  block.measuring_mode = payload[kMeasuringModeAt];
  block.variant = {u16_at(payload, kAngleAt), u16_at(payload, kResolutionAt)};
  block.restart_mode = payload[kRestartModeAt];
  block.restart_time = u16_at(payload, kRestartTimeAt);
  block.baud_word = u16_at(payload, kBaudAt);
  block.permanent_baud = payload[kPermanentBaudAt] != 0;
  block.address = payload[kAddressAt];
  block.field_set = payload[kFieldSetAt];
  block.unit = payload[kUnitAt];
  block.laser_on = payload[kLaserOnAt] != 0;
  block.prom_version = text_at(payload, kPromVersionAt);
  return block;
}

}  // namespace seeker::lms200
