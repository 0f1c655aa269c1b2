#include "server/drivers/hardware/hardware_devices.hpp"

#include <utility>

#include "server/drivers/hardware/laser_driver.hpp"
#include "server/drivers/hardware/p2os_drivers.hpp"
#include "server/drivers/link/line_address.hpp"
#include "server/drivers/lms200/lms_session.hpp"
#include "server/drivers/rplidar/rplidar_session.hpp"

namespace seeker::drivers {
namespace {

constexpr std::uint16_t kP2osPort = 8101;

Result<DeviceThreadParams> line_of(const HardwareSettings& settings, const std::string& port,
                                   std::uint16_t default_port) {
  Result<LineAddress> address = parse_line_address(port, default_port);
  if (!address) {
    return tl::unexpected<Error>(address.error());
  }
  DeviceThreadParams line;
  line.line = std::move(*address);
  line.first_reopen = settings.first_reopen;
  line.longest_reopen = settings.longest_reopen;
  return line;
}

Status make_base(const HardwareSettings& settings, HardwareDevices& made) {
  Result<DeviceThreadParams> line = line_of(settings, settings.base.port, kP2osPort);
  if (!line) {
    return fail_with_context("hardware.base.port", line.error());
  }
  P2osParams params = settings.base.p2os;
  params.serial = line->line.serial();
  if (const Status ok = validate(params); !ok) {
    return fail_with_context("hardware.base.p2os", ok.error());
  }
  auto link = std::make_shared<P2osLink>(params, std::move(*line), made.clock);
  made.base = std::make_shared<P2osBase>(link);
  if (params.use_sonar) {
    made.sonar = std::make_shared<P2osSonar>(std::move(link));
  }
  return {};
}

/// `field` is the section of the settings.
Result<std::shared_ptr<LidarDriver>> make_lidar(const HardwareSettings& settings, const LidarSettings& lidar,
                                                const std::string& field, const std::shared_ptr<const Clock>& clock) {
  Result<DeviceThreadParams> line = line_of(settings, lidar.port, 0);
  if (!line) {
    return fail_with_context(field + ".port", line.error());
  }
  switch (lidar.driver) {
    case LidarKind::kLms200:
      if (const Status ok = validate(lidar.lms200); !ok) {
        return fail_with_context(field + ".lms200", ok.error());
      }
      return std::make_shared<LaserDriver<LmsSession>>(lidar.lms200, std::move(*line), clock);
    case LidarKind::kRplidar:
      if (const Status ok = validate(lidar.rplidar); !ok) {
        return fail_with_context(field + ".rplidar", ok.error());
      }
      return std::make_shared<LaserDriver<RplidarSession>>(lidar.rplidar, std::move(*line), clock);
  }
  return fail(Errc::kInvalidArgument, field + ".driver is not known");
}

/// The scanner of an optional section; null where there is none.
Status make_lidar(const HardwareSettings& settings, const std::optional<LidarSettings>& lidar, const std::string& field,
                  const std::shared_ptr<const Clock>& clock, std::shared_ptr<LidarDriver>& made) {
  if (!lidar) {
    return {};
  }
  Result<std::shared_ptr<LidarDriver>> driver = make_lidar(settings, *lidar, field, clock);
  if (!driver) {
    return tl::unexpected<Error>(driver.error());
  }
  made = std::move(*driver);
  return {};
}

}  // namespace

std::string_view to_string(BaseKind kind) {
  switch (kind) {
    case BaseKind::kP2os: return "p2os";
  }
  return "unknown";
}

std::string_view to_string(LidarKind kind) {
  switch (kind) {
    case LidarKind::kLms200: return "lms200";
    case LidarKind::kRplidar: return "rplidar";
  }
  return "unknown";
}

Result<HardwareDevices> make_hardware(const HardwareSettings& settings) {
  HardwareDevices made;
  made.clock = std::make_shared<LiveClock>();
  if (const Status ok = make_base(settings, made); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  if (settings.second_lidar && !settings.lidar) {
    return fail(Errc::kInvalidArgument,
                "hardware.second_lidar: there is no first one; call a single scanner hardware.lidar");
  }
  if (const Status ok = make_lidar(settings, settings.lidar, "hardware.lidar", made.clock, made.lidar); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  if (const Status ok =
          make_lidar(settings, settings.second_lidar, "hardware.second_lidar", made.clock, made.second_lidar);
      !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  return made;
}

}  // namespace seeker::drivers
