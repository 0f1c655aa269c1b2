#include "server/protocols/p2os/gyro_packet.hpp"

#include <string>

#include "common/core/angle.hpp"
#include "common/core/assert.hpp"
#include "server/protocols/p2os/field_reader.hpp"
#include "server/protocols/p2os/field_writer.hpp"

namespace seeker::p2os {
namespace {

constexpr std::size_t kReadingBytes = 3;

}  // namespace

double gyro_rad_s_per_count(double scaler) {
  // The converter's range is 5 V; the gyroscope gives 2.5 V at 300 deg/s.
  constexpr double kVoltsPerCount = 5.0 / kGyroMaxCount;
  constexpr double kDegPerSecondPerVolt = 300.0 / 2.5;
  return deg_to_rad(kVoltsPerCount * kDegPerSecondPerVolt * scaler);
}

Result<std::vector<GyroReading>> read_gyro(const Packet& packet) {
  FieldReader in(packet.data);
  const auto count = in.u8();
  if (!count || in.left_bytes() < *count * kReadingBytes) {
    return fail(Errc::kCorrupt,
                "a gyroscope packet of " + std::to_string(packet.data.size()) + " bytes ends before its last reading");
  }
  std::vector<GyroReading> readings;
  readings.reserve(*count);
  for (std::size_t k = 0; k < *count; ++k) {
    const std::uint16_t rate = in.u16().value();
    readings.push_back({rate, in.u8().value()});
  }
  return readings;
}

Packet write_gyro(const std::vector<GyroReading>& readings) {
  SEEKER_ASSERT(readings.size() <= kMaxGyroReadings);
  FieldWriter out;
  out.u8(static_cast<std::uint8_t>(readings.size()));
  for (const GyroReading& reading : readings) {
    out.u16(reading.rate);
    out.u8(reading.temperature);
  }
  return {static_cast<std::uint8_t>(PacketId::kGyro), out.take()};
}

}  // namespace seeker::p2os
