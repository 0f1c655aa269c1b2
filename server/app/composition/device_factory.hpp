/// \file
/// From a robot file to its drivers: of a simulation, of a recording, of a place in an emulated world, of real cameras.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "server/app/composition/robot_options.hpp"
#include "server/app/runtime/devices.hpp"
#include "server/drivers/sim/sim_devices.hpp"

namespace seeker::app {

/// The drivers of one robot, and the simulation behind them where there is one (for scoring and fault injection).
struct MadeDevices {
  Devices devices;
  std::shared_ptr<sim::Simulation> simulation;
  std::shared_ptr<drivers::SimFaults> faults;
};

/// Drivers of several simulated robots in one world.
struct MadeSharedDevices {
  std::shared_ptr<sim::SharedWorld> world;
  std::shared_ptr<drivers::TickBarrier> barrier;
  std::vector<MadeDevices> robots;
};

/// Errors name the file or field that is wrong.
[[nodiscard]] Result<MadeDevices> make_devices(const RobotOptions& options);

/// At least one robot; the world, its speed and the periods of the devices are those of the first one's `sim` section.
[[nodiscard]] Result<MadeSharedDevices> make_shared_devices(std::span<const RobotOptions> robots);

}  // namespace seeker::app
