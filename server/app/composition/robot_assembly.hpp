/// \file
/// From a robot file to the parts of a robot: its drivers, its estimator and its behaviours.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "server/app/composition/robot_options.hpp"
#include "server/app/landmarks/landmark_library.hpp"
#include "server/app/loop/loop_params.hpp"
#include "server/drivers/sim/sim_devices.hpp"

namespace seeker::app {

/// The parts of a loop, and the simulation behind them where there is one (for scoring and fault injection).
struct Assembly {
  LoopParts parts;
  std::shared_ptr<sim::Simulation> simulation;
  std::shared_ptr<drivers::SimFaults> faults;
  std::shared_ptr<LandmarkLibrary> landmarks;
};

/// Errors name the file or field that is wrong. Without a folder in `landmarks` there are no databases of landmarks.
[[nodiscard]] Result<Assembly> assemble(const RobotOptions& options, LandmarkStorage landmarks = {});

/// Several simulated robots in one world: that of the first one's `sim` section, which also gives the speed and the
/// periods of the devices; seed, start and model are each robot's own.
struct SharedAssembly {
  std::shared_ptr<sim::SharedWorld> world;
  std::shared_ptr<drivers::TickBarrier> barrier;
  std::vector<Assembly> robots;
};

/// As assemble(), for at least one robot.
[[nodiscard]] Result<SharedAssembly> assemble_shared(std::span<const RobotOptions> robots);

}  // namespace seeker::app
