#include "server/protocols/rplidar/request.hpp"

#include "common/core/assert.hpp"
#include "server/protocols/rplidar/little_endian.hpp"

namespace seeker::rplidar {

std::vector<std::uint8_t> encode(const Request& request) {
  const auto command = static_cast<std::uint8_t>(request.command);
  const bool carries = (command & kPayloadBit) != 0;
  SEEKER_ASSERT(carries || request.payload.empty());
  SEEKER_ASSERT(request.payload.size() <= kMaxRequestPayload);
  std::vector<std::uint8_t> bytes{kRequestStart, command};
  if (carries) {
    bytes.push_back(static_cast<std::uint8_t>(request.payload.size()));
    bytes.insert(bytes.end(), request.payload.begin(), request.payload.end());
    std::uint8_t check = 0;
    for (const std::uint8_t byte : bytes) {
      check ^= byte;
    }
    bytes.push_back(check);
  }
  return bytes;
}

Request express_scan(std::uint8_t mode) { return {Command::kExpressScan, {mode, 0, 0, 0, 0}}; }

Request set_motor_pwm(std::uint16_t pwm) {
  Request request{Command::kSetMotorPwm, {}};
  write_u16(pwm, request.payload);
  return request;
}

Request get_acc_board_flag() { return {Command::kGetAccBoardFlag, {0, 0, 0, 0}}; }

Request get_conf(ConfType type) {
  Request request{Command::kGetConf, {}};
  write_u32(static_cast<std::uint32_t>(type), request.payload);
  return request;
}

Request get_conf(ConfType type, std::uint16_t mode) {
  Request request = get_conf(type);
  write_u16(mode, request.payload);
  return request;
}

}  // namespace seeker::rplidar
