/// \file
/// Devices that show a robot of the simulated world to programs which expect real ones.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "server/emulator/device_host.hpp"
#include "server/emulator/device_spec.hpp"
#include "server/emulator/mjpeg_port.hpp"
#include "server/sim/shared_world.hpp"

namespace seeker::emulator {

/// All devices of a world. `world` must outlive it.
class WorldDevices {
 public:
  /// kInvalidArgument: a robot that the world has not.
  [[nodiscard]] static Result<WorldDevices> make(sim::SharedWorld& world, const std::vector<DeviceSpec>& specs,
                                                 std::uint64_t seed);

  /// Lets hosts reach the devices. Errors are those of DeviceHost::plug() and MjpegPort::plug().
  [[nodiscard]] Status plug();
  [[nodiscard]] Status add(FaultCommand fault) { return host_->add(std::move(fault)); }
  /// The world has come to a new time.
  void step();
  /// Name and address of each device, one a line.
  [[nodiscard]] std::string addresses() const;

 private:
  WorldDevices(sim::SharedWorld& world, std::vector<HostedDevice> devices, std::uint64_t seed)
      : world_(&world), host_(std::make_unique<DeviceHost>(std::move(devices), seed)) {}

  sim::SharedWorld* world_;
  std::unique_ptr<DeviceHost> host_;
  std::vector<std::unique_ptr<MjpegPort>> cameras_;
};

}  // namespace seeker::emulator
