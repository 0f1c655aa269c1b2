/// \file
/// Robots of a fleet that report where they go and what they have seen.
#pragma once

#include "tests/integration/fleet/fleet_world.hpp"
#include "tests/integration/fleet/toy_robot.hpp"
#include "tests/support/matchers.hpp"

namespace seeker::testing {

inline const Point2 kPlace(2.0, 1.0);

/// A main robot that does not give up on the silent.
inline app::FleetLeaderParams patient_params(const std::string& folder) {
  app::FleetLeaderParams params = leader_params(folder);
  params.silence_limit = std::chrono::hours(1);
  return params;
}

inline bool placed(const api::FleetMember& member) {
  return member.state == api::FleetState::kMerged && member.main_T_map.has_value();
}

inline api::FleetShared answer_to(app::FleetLeader& leader, const std::string& robot_id,
                                  const std::optional<RobotTopology>& topology, std::uint64_t instance = 1) {
  const auto shared = leader.share({robot_id, instance, topology});
  EXPECT_TRUE(shared) << shared.error().message;
  return shared ? *shared : api::FleetShared{};
}

}  // namespace seeker::testing
