/// \file
/// A robot whose map the test writes.
#pragma once

#include <memory>

#include "server/app/composition/robot_assembly.hpp"
#include "server/app/estimators/tracker_estimator.hpp"
#include "tests/support/maps/fake_map_tracker.hpp"

namespace seeker::testing {

/// The parts of a robot, with `map` in the place of what its estimator would make of the world.
[[nodiscard]] inline app::Assembly assemble_with_map(const app::RobotOptions& options,
                                                     const std::shared_ptr<FakeMapState>& map) {
  app::Assembly assembly = app::assemble(options).value();
  assembly.parts.estimator = std::make_unique<app::TrackerEstimator>(std::make_unique<FakeMapTracker>(map));
  return assembly;
}

}  // namespace seeker::testing
