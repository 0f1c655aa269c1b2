/// \file
/// Which real devices a robot has, and where they are connected.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "server/drivers/lms200/lms_params.hpp"
#include "server/drivers/p2os/p2os_params.hpp"
#include "server/drivers/rplidar/rplidar_params.hpp"

namespace seeker::drivers {

enum class BaseKind : std::uint8_t { kP2os };
enum class LidarKind : std::uint8_t { kLms200, kRplidar };

inline constexpr std::array kBaseKinds{BaseKind::kP2os};
inline constexpr std::array kLidarKinds{LidarKind::kLms200, LidarKind::kRplidar};

/// Names as in robot files.
[[nodiscard]] std::string_view to_string(BaseKind kind);
[[nodiscard]] std::string_view to_string(LidarKind kind);

struct BaseSettings {
  BaseKind driver = BaseKind::kP2os;
  std::string port = "/dev/ttyUSB0";  ///< serial port, or tcp://HOST:PORT (P2OS: port 8101 where none is named)
  P2osParams p2os;
};

struct LidarSettings {
  LidarKind driver = LidarKind::kLms200;
  std::string port = "/dev/ttyUSB1";  ///< as BaseSettings::port
  LmsParams lms200;
  RplidarParams rplidar;
};

struct HardwareSettings {
  BaseSettings base;
  std::optional<LidarSettings> lidar;
  /// Another scanner, whose scans are merged with those of `lidar`.
  std::optional<LidarSettings> second_lidar;
  /// Delays between attempts to open a port that is lost: they double from the first to the longest.
  Duration first_reopen = std::chrono::milliseconds(250);
  Duration longest_reopen = std::chrono::seconds(4);
};

}  // namespace seeker::drivers
