#include "server/protocols/lms200/config_block.hpp"

#include <algorithm>

#include "common/core/assert.hpp"
#include "server/protocols/lms200/little_endian.hpp"

namespace seeker::lms200 {
namespace {

constexpr std::size_t kContoursAt = 12;
constexpr std::size_t kPixelEvaluationAt = 28;
constexpr std::size_t kSingleValueAt = 29;
constexpr std::size_t kRestartTimesAt = 30;
constexpr std::size_t kDazzleAt = 32;

}  // namespace

std::array<std::uint8_t, ConfigBlock::kBytes> encode(const ConfigBlock& block) {
  std::array<std::uint8_t, ConfigBlock::kBytes> bytes{};
  put_u16(bytes, 0, block.blanking);
  bytes[2] = block.stop_threshold;
  bytes[3] = block.peak_threshold;
  bytes[4] = block.availability;
  bytes[5] = block.measuring_mode;
  bytes[6] = block.unit;
  bytes[7] = block.temporary_field;
  bytes[8] = block.subtractive_fields;
  bytes[9] = block.multiple_evaluation;
  bytes[10] = block.restart;
  bytes[11] = block.restart_time;
  std::copy(block.contours.begin(), block.contours.end(), bytes.begin() + kContoursAt);
  bytes[kPixelEvaluationAt] = block.pixel_evaluation;
  bytes[kSingleValueAt] = block.single_value_evaluation;
  put_u16(bytes, kRestartTimesAt, block.restart_times_b_c);
  put_u16(bytes, kDazzleAt, block.dazzle_multiple_evaluation);
  return bytes;
}

ConfigBlock decode_config(std::span<const std::uint8_t, ConfigBlock::kBytes> bytes) {
  ConfigBlock block;
  block.blanking = u16_at(bytes, 0);
  block.stop_threshold = bytes[2];
  block.peak_threshold = bytes[3];
  block.availability = bytes[4];
  block.measuring_mode = bytes[5];
  block.unit = bytes[6];
  block.temporary_field = bytes[7];
  block.subtractive_fields = bytes[8];
  block.multiple_evaluation = bytes[9];
  block.restart = bytes[10];
  block.restart_time = bytes[11];
  std::copy_n(bytes.begin() + kContoursAt, block.contours.size(), block.contours.begin());
  block.pixel_evaluation = bytes[kPixelEvaluationAt];
  block.single_value_evaluation = bytes[kSingleValueAt];
  block.restart_times_b_c = u16_at(bytes, kRestartTimesAt);
  block.dazzle_multiple_evaluation = u16_at(bytes, kDazzleAt);
  return block;
}

ConfigBlock overwritten(const ConfigBlock& block, std::span<const std::uint8_t> leading) {
  SEEKER_ASSERT(leading.size() <= ConfigBlock::kBytes);
  std::array<std::uint8_t, ConfigBlock::kBytes> bytes = encode(block);
  std::copy(leading.begin(), leading.end(), bytes.begin());
  return decode_config(bytes);
}

}  // namespace seeker::lms200
