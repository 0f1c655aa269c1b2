/// \file
/// Which devices an emulated robot shows, and where.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "common/core/result.hpp"

namespace seeker::emulator {

enum class DeviceKind : std::uint8_t { kP2os, kLms200, kRplidarA1, kRplidarA2, kCamera };
inline constexpr std::array kDeviceKinds{DeviceKind::kP2os, DeviceKind::kLms200, DeviceKind::kRplidarA1,
                                         DeviceKind::kRplidarA2, DeviceKind::kCamera};
[[nodiscard]] std::string_view to_string(DeviceKind kind);

struct DeviceSpec {
  DeviceKind kind = DeviceKind::kP2os;
  std::string path;        ///< link to a pseudo-terminal; empty: TCP
  std::string host;        ///< address to listen on
  std::uint16_t port = 0;  ///< 0: any free one
  std::size_t robot = 0;   ///< which robot of the world it belongs to

  friend bool operator==(const DeviceSpec&, const DeviceSpec&) = default;
};

/// Reads "KIND@LINE[#ROBOT]" with LINE a path or tcp://HOST:PORT: "p2os@/run/base", "camera@tcp://127.0.0.1:8080",
/// "lms200@/run/laser#1". A camera is reached by TCP only. Errors show the form and the kinds.
[[nodiscard]] Result<DeviceSpec> parse_device_spec(std::string_view text);

}  // namespace seeker::emulator
