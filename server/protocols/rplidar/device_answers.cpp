#include "server/protocols/rplidar/device_answers.hpp"

#include <algorithm>

#include "common/core/assert.hpp"
#include "server/protocols/rplidar/descriptor.hpp"
#include "server/protocols/rplidar/little_endian.hpp"

namespace seeker::rplidar {
namespace {

constexpr std::size_t kSerialAt = 4;

std::vector<std::uint8_t> announce(AnswerType type, std::size_t length) {
  const auto head = encode(Descriptor{static_cast<std::uint32_t>(length), false, type});
  std::vector<std::uint8_t> bytes;
  bytes.reserve(head.size() + length);
  bytes.assign(head.begin(), head.end());
  return bytes;
}

}  // namespace

std::vector<std::uint8_t> encode(const DeviceInfo& info) {
  std::vector<std::uint8_t> bytes = announce(AnswerType::kInfo, kInfoBytes);
  bytes.insert(bytes.end(), {info.model, info.firmware.minor, info.firmware.major, info.hardware});
  bytes.insert(bytes.end(), info.serial.begin(), info.serial.end());
  return bytes;
}

std::vector<std::uint8_t> encode(const Health& health) {
  std::vector<std::uint8_t> bytes = announce(AnswerType::kHealth, kHealthBytes);
  bytes.push_back(static_cast<std::uint8_t>(health.status));
  write_u16(health.code, bytes);
  return bytes;
}

std::vector<std::uint8_t> encode(const SampleRate& rate) {
  std::vector<std::uint8_t> bytes = announce(AnswerType::kSampleRate, kSampleRateBytes);
  write_u16(rate.legacy_us, bytes);
  write_u16(rate.express_us, bytes);
  return bytes;
}

std::vector<std::uint8_t> encode(const ConfAnswer& answer) {
  SEEKER_ASSERT(kConfTypeBytes + answer.data.size() <= kMaxConfBytes);
  std::vector<std::uint8_t> bytes = announce(AnswerType::kConf, kConfTypeBytes + answer.data.size());
  write_u32(static_cast<std::uint32_t>(answer.type), bytes);
  bytes.insert(bytes.end(), answer.data.begin(), answer.data.end());
  return bytes;
}

std::vector<std::uint8_t> encode(const AccBoard& board) {
  std::vector<std::uint8_t> bytes = announce(AnswerType::kAccBoard, kAccBoardBytes);
  write_u32(board.controls_motor ? 1U : 0U, bytes);
  return bytes;
}

std::optional<DeviceInfo> decode_info(std::span<const std::uint8_t> payload) {
  if (payload.size() != kInfoBytes) {
    return std::nullopt;
  }
  DeviceInfo info{payload[0], {.major = payload[2], .minor = payload[1]}, payload[3], {}};
  std::copy(payload.begin() + kSerialAt, payload.end(), info.serial.begin());
  return info;
}

std::optional<Health> decode_health(std::span<const std::uint8_t> payload) {
  if (payload.size() != kHealthBytes || payload[0] > static_cast<std::uint8_t>(HealthStatus::kProtectionStop)) {
    return std::nullopt;
  }
  return Health{static_cast<HealthStatus>(payload[0]), read_u16(payload, 1)};
}

std::optional<SampleRate> decode_sample_rate(std::span<const std::uint8_t> payload) {
  if (payload.size() != kSampleRateBytes) {
    return std::nullopt;
  }
  return SampleRate{read_u16(payload, 0), read_u16(payload, 2)};
}

std::optional<ConfAnswer> decode_conf(std::span<const std::uint8_t> payload) {
  if (payload.size() < kConfTypeBytes || payload.size() > kMaxConfBytes) {
    return std::nullopt;
  }
  const auto data = payload.subspan(kConfTypeBytes);
  return ConfAnswer{static_cast<ConfType>(read_u32(payload, 0)), {data.begin(), data.end()}};
}

std::optional<AccBoard> decode_acc_board(std::span<const std::uint8_t> payload) {
  if (payload.size() != kAccBoardBytes) {
    return std::nullopt;
  }
  return AccBoard{(read_u32(payload, 0) & 1U) != 0};
}

}  // namespace seeker::rplidar
