/// \file
/// From a robot file to a robot: drivers, estimator, behaviours.
#pragma once

#include <memory>

#include "server/app/devices.hpp"
#include "server/app/landmark_library.hpp"
#include "server/app/robot_loop.hpp"
#include "server/app/robot_options.hpp"
#include "server/drivers/sim/sim_devices.hpp"

namespace seeker::app {

/// The parts of a loop, and the simulation behind them where there is one (for scoring and fault injection).
struct Assembly {
  LoopParts parts;
  std::shared_ptr<sim::Simulation> simulation;
  std::shared_ptr<drivers::SimFaults> faults;
  LandmarkUse landmarks;
};

/// Errors name the file or field that is wrong. Without a folder in `landmarks` there are no databases of landmarks.
[[nodiscard]] Result<Assembly> assemble(const RobotOptions& options, LandmarkStorage landmarks = {});

}  // namespace seeker::app
