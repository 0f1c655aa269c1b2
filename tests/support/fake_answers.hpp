/// \file
/// What the fake robot answers where that takes more than a line.
#pragma once

#include <string>
#include <vector>

#include "tests/support/fake_robot.hpp"

namespace seeker::testing {

/// Who asks is `me`.
[[nodiscard]] Result<api::LeaseState> fake_lease(api::LeaseState& state, api::LeaseAction action,
                                                 const std::string& me);

[[nodiscard]] std::vector<api::LandmarkSummary> fake_list_landmarks(const FakeRobotValues& values);
[[nodiscard]] Result<api::LandmarkSummary> fake_inspect_landmarks(const FakeRobotValues& values,
                                                                  const std::string& name);
[[nodiscard]] Result<std::vector<api::LandmarkPoint>> fake_landmarks(const FakeRobotValues& values,
                                                                     const std::string& name);
/// Takes a pruning back, once.
[[nodiscard]] Result<api::LandmarkSummary> fake_revert_landmarks(FakeRobotValues& values, const std::string& name);
[[nodiscard]] Result<api::LandmarkSummary> fake_prune_landmarks(FakeRobotValues& values, const std::string& name,
                                                                int min_views);

}  // namespace seeker::testing
